#pragma once

#include <filesystem>
#include <vector>

namespace fathom::app {

/// Makes a folder where there is none yet. Fails with OutputError.
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
