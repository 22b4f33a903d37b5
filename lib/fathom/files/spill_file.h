#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "fathom/files/descriptor.h"
#include "fathom/files/file_bytes.h"

namespace fathom::files {

/// Bytes that wait on a disk for want of memory, in a file without a name: it is gone with the
/// object, and with the process, however that ends. Several threads may write and read at the same
/// time.
class SpillFile {
 public:
  /// In `folder`; if it is empty, in the folder that TMPDIR names, or else in /tmp.
  /// Fails    OutputError "FOLDER: why", or "TMPDIR: why".
  explicit SpillFile(std::filesystem::path folder = {});

  /// Writes bytes behind all others, and returns where they begin.
  /// Fails    OutputError: the disk is full.
  std::uint64_t append(ByteView bytes);
  /// Writes bytes over others.
  void write(std::uint64_t offset, ByteView bytes);
  /// Reads what has been written.
  /// Fails    InputError.
  void read(std::uint64_t offset, std::span<std::byte> bytes) const;
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  std::string name_;
  Descriptor file_;
  std::atomic<std::uint64_t> size_ = 0;
};

}  // namespace fathom::files
