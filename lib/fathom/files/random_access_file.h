#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "fathom/files/file_state.h"

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

  /// Fails    InputError where the file has been written to or cut since it was opened.
  void expect_unchanged() const;

 private:
  std::string name_;
  int descriptor_ = -1;
  FileState opened_;
};

}  // namespace fathom::files
