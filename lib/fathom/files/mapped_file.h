#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace fathom::files {

struct MappedRange;

/// Bytes of a file as memory, as long as this lives. Where another program cuts the file short
/// meanwhile, reading the bytes that are gone ends in the signal SIGBUS: there is no other way to
/// tell. A program that handles the signal learns from mapped_file_at() which file it was; the
/// library itself installs no handler.
class MappedFile {
 public:
  MappedFile() = default;
  /// Maps the bytes [offset, offset + size) of an open file called `name`, with size > 0. Where
  /// that cannot be, is_mapped() is false and errno says why.
  MappedFile(int descriptor, std::uint64_t offset, std::size_t size, const std::string& name);
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  [[nodiscard]] bool is_mapped() const { return mapping_ != nullptr; }
  /// The byte at `offset`.
  [[nodiscard]] const std::byte* data() const { return data_; }

 private:
  void* mapping_ = nullptr;
  std::size_t mapped_ = 0;
  const std::byte* data_ = nullptr;
  MappedRange* range_ = nullptr;
};

/// The printable name of the file that is mapped at this address; nullptr if there is no such file.
/// May be called by a signal handler.
const char* mapped_file_at(const void* address) noexcept;

}  // namespace fathom::files
