#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/text/confinement.h"

namespace fathom::text {

/// The bytes of an input file, or of standard input if the path is "-".
///
/// Large regular files are mapped, so that they take no memory of ours; small ones, pipes and
/// standard input are read into memory, up to their end.
class InputFile {
 public:
  /// Fails    InputError "PATH: why": missing, not readable, or a directory.
  explicit InputFile(const std::filesystem::path& path);
  /// A file that another file names; "-" is an ordinary name. Fails    as open_confined().
  InputFile(const std::filesystem::path& path, const std::vector<Boundary>& boundaries);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::string_view text() const {
    return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};
  }

 private:
  void take(int descriptor, const std::string& name, bool may_be_mapped);
  void read(int descriptor, std::size_t capacity, const std::string& name);

  std::span<const std::byte> bytes_;
  std::unique_ptr<std::byte[]> buffer_;
  void* mapping_ = nullptr;
};

}  // namespace fathom::text
