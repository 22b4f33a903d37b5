#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/files/descriptor.h"

namespace fathom::files {

/// A regular file that is read here and there, however large it is; nothing of it stays in memory.
/// Several threads may read at the same time.
class RandomAccessFile {
 public:
  /// Fails    InputError "PATH: why": missing, not readable, or not a regular file.
  explicit RandomAccessFile(const std::filesystem::path& path);
  RandomAccessFile(const RandomAccessFile&) = delete;
  RandomAccessFile& operator=(const RandomAccessFile&) = delete;
  ~RandomAccessFile();

  /// The size when the file was opened.
  [[nodiscard]] std::uint64_t size() const { return opened_.size; }
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] int descriptor() const { return descriptor_; }

  /// Fills `bytes` from `offset` on.
  /// Fails    InputError if the file has fewer bytes, having been cut short since, or cannot be
  ///          read.
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

  /// Fails    InputError if the file has been written to or cut since it was opened.
  void expect_unchanged() const;

 private:
  std::string name_;
  int descriptor_ = -1;
  FileState opened_;
};

/// Walks over bytes from first to last, which are in memory or are read from a file piece by piece.
class ByteWindow {
 public:
  /// Bytes in memory, which must outlive this; the first has the number `offset` in its file.
  ByteWindow(std::string_view bytes, std::uint64_t offset)
      : at_(bytes.data()), end_(at_ + bytes.size()), end_offset_(offset + bytes.size()) {}
  /// The bytes [offset, end) of a file, which must outlive this, at most `capacity` at a time (at
  /// least 8).
  ByteWindow(const RandomAccessFile& file, std::uint64_t offset, std::uint64_t end,
             std::size_t capacity)
      : end_offset_(offset),
        file_(&file),
        unread_(end - offset),
        buffer_(static_cast<std::size_t>(std::min<std::uint64_t>(capacity, unread_))) {
    at_ = end_ = buffer_.data();
  }

  ByteWindow(ByteWindow&&) = default;  // the buffer's bytes stay where they are

  /// The next byte, followed by the bytes that are certainly in memory.
  [[nodiscard]] const char* at() const { return at_; }
  /// Whether `count` more bytes (at most 8) lie at at(), if necessary after reading on.
  bool has(std::size_t count) {
    return static_cast<std::size_t>(end_ - at_) >= count || read_on(count);
  }
  /// Whether `count` more bytes, however many, lie at at() without reading on.
  [[nodiscard]] bool has_at_hand(std::size_t count) const {
    return static_cast<std::size_t>(end_ - at_) >= count;
  }
  void advance(std::size_t count) { at_ += count; }
  /// Back over bytes that were just advanced over.
  void back(std::size_t count) { at_ -= count; }
  /// Leaves out `count` bytes, at most as many as rest().
  void skip(std::uint64_t count);

  [[nodiscard]] std::uint64_t rest() const {
    return static_cast<std::uint64_t>(end_ - at_) + unread_;
  }
  /// Number of the next byte in its file.
  [[nodiscard]] std::uint64_t position() const {
    return end_offset_ - static_cast<std::uint64_t>(end_ - at_);
  }

 private:
  bool read_on(std::size_t count);

  const char* at_;
  const char* end_;
  /// Number of the byte at end_ in the file, and how many after it are still to be read.
  std::uint64_t end_offset_;
  const RandomAccessFile* file_ = nullptr;
  std::uint64_t unread_ = 0;
  std::vector<char> buffer_;
};

/// Small pieces of a file, here and there, through blocks that stay in memory (4 MiB in all).
/// Slower than MappedFile; but a file that is cut short meanwhile is an error, not a signal.
///
/// Several threads may read at the same time.
class FileBlocks {
 public:
  /// The file must outlive this.
  explicit FileBlocks(const RandomAccessFile& file);

  /// Fills `bytes` from `offset` on.
  /// Fails    as RandomAccessFile::read().
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;

 private:
  static constexpr std::size_t block_size = 4096, block_count = 1024;

  struct Block {
    std::mutex mutex;
    /// Which block of the file `bytes` hold.
    std::uint64_t number = UINT64_MAX;
    std::array<std::byte, block_size> bytes;
  };

  void load(Block& block, std::uint64_t number) const;

  const RandomAccessFile& file_;
  /// Block n of the file has place n % block_count.
  std::unique_ptr<std::array<Block, block_count>> blocks_;
};

}  // namespace fathom::files
