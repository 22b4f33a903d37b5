#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace fathom::text {

/// The bytes of an input file, or of standard input where the path is "-".
///
/// Large regular files are mapped, so that they take no memory of ours; small ones, pipes and
/// standard input are read into memory, as far as they reach.
class InputFile {
 public:
  /// Fails    InputError "PATH: why": not there, not readable, a directory.
  explicit InputFile(const std::filesystem::path& path);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::string_view text() const {
    return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};
  }

 private:
  void read(int descriptor, std::size_t capacity, const std::string& name);

  std::span<const std::byte> bytes_;
  std::unique_ptr<std::byte[]> buffer_;
  void* mapping_ = nullptr;
};

}  // namespace fathom::text
