#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/files/descriptor.h"
#include "fathom/files/mapped_file.h"

/// Reads input files, and checks which files another file may name: a scene file its meshes, a glTF
/// asset its buffers.
namespace fathom::files {

/// A folder that contains, at any depth, all files that other files may name.
struct Boundary {
  std::filesystem::path folder;
  /// Ends the message of a refusal: "FILE: lies outside FOLDER, RULE".
  std::string rule;
};

/// The boundary of every file that another file names, where `folder` confines them; none if it
/// is empty.
std::vector<Boundary> boundaries_of(const std::filesystem::path& folder);

/// Opens a file that another file names, for reading. It must be a regular file: pipes and devices
/// are refused without opening them. After following all symbolic links it must lie in the folder
/// of every boundary. The opened file itself is examined, so exchanging a link meanwhile has no
/// effect.
/// Fails    InputError "PATH: …": as above, missing or not readable; with boundaries, also without
///          /proc, which reports where a file lies.
Descriptor open_confined(const std::filesystem::path& path,
                         const std::vector<Boundary>& boundaries);

/// At most this many bytes are read from files that are not regular: pipes, standard input, files
/// of /proc. Their size is unknown, and some have no end.
inline constexpr std::uint64_t largest_unsized_input = std::uint64_t{1} << 30;

/// The bytes of an input file, or of standard input if the path is "-".
///
/// The whole file is read into memory, so that later changes of the file have no effect. A program
/// that handles the signal SIGBUS may map large regular files instead, which then take no memory of
/// the process (see MappedFile).
class InputFile {
 public:
  enum class Reading { copied, mapped_where_large };

  /// Fails    InputError "PATH: why": missing, not readable, a directory, a device other than
  ///          standard input, truncated during reading, or more than largest_unsized_input bytes
  ///          from a file that is not regular.
  explicit InputFile(const std::filesystem::path& path, Reading reading = Reading::copied);
  /// A file that another file names; "-" is an ordinary name. Fails    as open_confined().
  InputFile(const std::filesystem::path& path, const std::vector<Boundary>& boundaries,
            Reading reading = Reading::copied);
  /// Bytes that are there already; they must outlive this.
  explicit InputFile(std::span<const std::byte> bytes) : bytes_(bytes) {}
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::string_view text() const {
    return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()};
  }

  /// Checks that all bytes come from one state of the file; call it when the bytes have been used.
  /// Fails    InputError if a regular file was written to while it was read or, if it is mapped,
  ///          since. (A mapped file that is cut within its last page ends in zeros, without a
  ///          signal.)
  void expect_unchanged() const;

 private:
  struct Free {
    void operator()(std::byte* bytes) const { std::free(bytes); }
  };

  void take(Descriptor file, Reading reading);
  /// Makes the buffer larger or smaller; its contents stay.
  void resize(std::size_t capacity);
  void read(int descriptor, std::uint64_t size);

  std::string name_;
  std::span<const std::byte> bytes_;
  std::unique_ptr<std::byte, Free> buffer_;
  MappedFile mapped_;
  /// A mapped file, to ask for its state.
  Descriptor file_;
  /// States of a regular file: when it was opened, and when it had been read.
  FileState opened_, read_;
};

/// The folder in which an input looks for the files that it names: its own; for standard input or a
/// pipe, which lie in none, the working directory.
std::filesystem::path folder_of_input(const std::filesystem::path& path);

}  // namespace fathom::files
