#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fathom::app {

/// The folder that a file's name puts it in: "." where it names none.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// The destination that the name of an output leads to.
struct OutputPlace {
  /// The file that is meant, which need not exist: symbolic links are followed.
  std::filesystem::path path;
  /// The number of this process's open file that it names: 1 for /dev/stdout.
  std::optional<int> open_file;
  /// It lies in /proc, where nothing can be put.
  bool is_foreign = false;
};

/// Fails    OutputError where links lead in a circle.
OutputPlace place_of(const std::filesystem::path& target);

/// Whether writes to this name go directly into a device, a pipe or an open file, whose name needs
/// no suffix.
bool is_written_through(const std::filesystem::path& target);

/// The name of a picture as an argument: it ends in .png, or is a device, a pipe or an open file.
/// Fails    UsageError: "'text' does not end in .png".
std::string parse_png_name(const std::string& text);

/// Makes a folder unless it exists. Fails with OutputError.
void make_folder(const std::filesystem::path& folder);

/// The folder itself, or the nearest one above it that exists. Files move between the two: a folder
/// that is yet to be made lies in the same file system.
std::filesystem::path nearest_existing(const std::filesystem::path& folder);

/// Folders that are made for outputs. Unless these are kept, they go again with this object, except
/// where something else has been put into them meanwhile.
class NewFolders {
 public:
  NewFolders() = default;
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;
  ~NewFolders();

  /// Makes the folder and those above it, where they do not exist.
  /// Fails    std::system_error.
  void make(const std::filesystem::path& folder);
  void keep() { made_.clear(); }
  /// The folders that were made, outer ones first.
  [[nodiscard]] const std::vector<std::filesystem::path>& made() const { return made_; }

 private:
  std::vector<std::filesystem::path> made_;
};

}  // namespace fathom::app
