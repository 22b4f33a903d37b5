#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "fathom/files/random_access_file.h"

namespace fathom::files {

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

  /// The next byte and those that certainly follow it in memory.
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

}  // namespace fathom::files
