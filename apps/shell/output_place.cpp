#include "apps/shell/output_place.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <system_error>

#include "apps/shell/standard_streams.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

namespace fs = std::filesystem;

/// The folder of a file, with all links resolved; empty if it does not exist.
fs::path true_folder_of(const fs::path& file) {
  std::error_code error;
  const fs::path found = fs::canonical(folder_of(file), error);
  return error ? fs::path() : found;
}

std::optional<int> number_in(const std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

OutputPlace place_of(const fs::path& target) {
  const fs::path own_files = "/proc/" + std::to_string(::getpid()) + "/fd";
  OutputPlace place{.path = target};
  for (int links = 0;; ++links) {
    const fs::path folder = true_folder_of(place.path);
    if (folder == own_files) {
      place.open_file = number_in(place.path.filename().string());
    }
    place.is_foreign = place.open_file || folder.native().starts_with("/proc/");
    std::error_code error;
    const fs::path next = fs::read_symlink(place.path, error);
    if (error || place.is_foreign) return place;
    if (links == 40) fail_with_errno(target, ELOOP);
    place.path = next.is_absolute() ? next : place.path.parent_path() / next;
  }
}

bool is_written_through(const fs::path& target) {
  std::error_code error;
  return fs::is_other(fs::status(target, error)) || place_of(target).open_file.has_value();
}

std::string parse_png_name(const std::string& text) {
  const std::string suffix = fs::path(text).extension().string();
  if (suffix == ".png" || suffix == ".PNG" || is_written_through(text)) return text;
  throw UsageError("'" + text + "' does not end in .png");
}

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
