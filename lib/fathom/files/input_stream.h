#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "fathom/files/descriptor.h"

namespace fathom::files {

/// Opens an input file for reading.
/// Fails    InputError "PATH: why": missing, not readable, a directory, or a device other than
///          /dev/null and standard input.
Descriptor open_input(const std::string& name);

/// An input file, or standard input if the path is "-", from its first byte to its last. It may be
/// a pipe, and of any length, because its bytes are not kept.
class InputStream {
 public:
  /// Fails    as open_input().
  explicit InputStream(const std::filesystem::path& path);

  /// The bytes from here to the end; nullopt if the file is not regular.
  [[nodiscard]] std::optional<std::uint64_t> rest() const { return rest_; }

  /// Fills `bytes` with the next bytes of the file, and returns their number, which is less than
  /// bytes.size() only at the end of the file.
  /// Fails    InputError "PATH: why": the file cannot be read; or, at the end of a regular file, it
  ///          has been written to since it was opened.
  std::size_t read(std::span<std::byte> bytes);

 private:
  std::string name_;
  Descriptor file_;
  std::optional<std::uint64_t> rest_;
  /// The state of a regular file when it was opened.
  FileState opened_;
};

}  // namespace fathom::files
