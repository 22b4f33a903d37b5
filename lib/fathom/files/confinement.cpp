#include "fathom/files/confinement.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <system_error>

#include "fathom/failures/errors.h"
#include "fathom/files/descriptor.h"

namespace fathom::files {
namespace {

bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto [in_folder, in_file] =
      std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return in_folder == folder.end() && in_file != file.end();
}

/// Where an open file lies, without symbolic links.
std::filesystem::path place_of(const Descriptor& file, const std::string& name) {
  std::error_code error;
  auto place = std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file.get()), error);
  if (!error) return place;
  throw InputError(name + ": where it lies cannot be found out: " + error.message());
}

void check_boundary(const std::filesystem::path& place, const Boundary& boundary,
                    const std::string& name) {
  const std::filesystem::path written =
      boundary.folder.empty() ? std::filesystem::path(".") : boundary.folder;
  std::error_code error;
  const auto folder = std::filesystem::canonical(written, error);
  if (error) throw InputError(written.string() + ": cannot be opened: " + error.message());
  if (lies_in(place, folder)) return;
  throw InputError(name + ": lies outside " + written.string() + ", " + boundary.rule);
}

struct stat examine(const Descriptor& file, const std::string& name) {
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail_with_errno(name, "cannot be examined");
  return status;
}

}  // namespace

std::vector<Boundary> boundaries_of(const std::filesystem::path& folder) {
  if (folder.empty()) return {};
  return {{folder, "to which files named by other files are confined"}};
}

Descriptor open_confined(const std::filesystem::path& path,
                         const std::vector<Boundary>& boundaries) {
  const std::string name = path.string();
  // A handle to look at, not to read from: nothing happens to a device or a pipe.
  const Descriptor found{::open(name.c_str(), O_PATH | O_CLOEXEC)};
  if (!found.is_open()) fail_with_errno(name, "cannot be opened");
  const struct stat expected = examine(found, name);
  // First where, then what: nothing is said of files outside.
  if (!boundaries.empty()) {
    const std::filesystem::path place = place_of(found, name);
    for (const Boundary& boundary : boundaries) check_boundary(place, boundary, name);
  }
  if (S_ISDIR(expected.st_mode)) throw InputError(name + ": is a directory, expected a file");
  if (!S_ISREG(expected.st_mode)) {
    throw InputError(name + ": is not a regular file, as a file named by another must be");
  }
  Descriptor opened{::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)};
  if (!opened.is_open()) fail_with_errno(name, "cannot be opened");
  const struct stat status = examine(opened, name);
  if (status.st_dev != expected.st_dev || status.st_ino != expected.st_ino) {
    throw InputError(name + ": was exchanged while it was opened");
  }
  return opened;
}

}  // namespace fathom::files
