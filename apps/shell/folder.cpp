#include "apps/shell/folder.h"

#include <fmt/core.h>

#include <system_error>

#include "apps/shell/output_place.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

namespace fs = std::filesystem;

}  // namespace

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error)) {
    throw OutputError(fmt::format("{}: cannot make this folder: {}", folder.string(),
                                  error ? error.message() : "it is a file"));
  }
}

fs::path nearest_existing(const fs::path& folder) {
  fs::path nearest = folder;
  std::error_code error;
  // A link that leads nowhere exists too: no folder can be made in its place.
  while (fs::symlink_status(nearest, error).type() == fs::file_type::not_found) {
    const fs::path above = folder_of(nearest);
    if (above == nearest) break;
    nearest = above;
  }
  return nearest;
}

void NewFolders::make(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  const fs::path above = folder_of(folder);
  if (above != folder) make(above);
  made_.reserve(made_.size() + 1);
  // "new/." and "new/.." are there once "new" is; another program may have been quicker.
  if (fs::create_directory(folder, error)) {
    made_.push_back(folder);
  } else if (error) {
    throw std::system_error(error);
  }
}

NewFolders::~NewFolders() {
  std::error_code error;
  while (!made_.empty()) {
    fs::remove(made_.back(), error);
    made_.pop_back();
  }
}

}  // namespace fathom::app
