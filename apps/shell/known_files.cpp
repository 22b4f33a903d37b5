#include "apps/shell/known_files.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/files/descriptor.h"

namespace fathom::app {
namespace {

namespace fs = std::filesystem;

using Identity = std::pair<dev_t, ino_t>;

std::optional<Identity> identity_of(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return std::nullopt;
  return Identity{status.st_dev, status.st_ino};
}

/// Whether both names lead to one file now.
bool are_one_file(const fs::path& first, const fs::path& second) {
  // As long as a file is open, the system gives its number to no other file.
  const files::Descriptor held(::open(first.c_str(), O_PATH | O_CLOEXEC));
  struct stat status {};
  if (!held.is_open() || ::fstat(held.get(), &status) != 0) return false;
  return identity_of(second) == Identity{status.st_dev, status.st_ino};
}

/// Files, identified by device and inode number and by place: a new file has only a place, and hard
/// links share only the inode.
///
/// The system reuses the inode number of a deleted file, and another process of the same job may
/// replace files at any time. So an equal number only leads to the place of a known file; the file
/// at that place decides whether it is the same.
class KnownFiles {
 public:
  [[nodiscard]] bool contains(const fs::path& file) const {
    const std::string place = place_of(file);
    if (places_.contains(place)) return true;
    const auto identity = identity_of(file);
    if (!identity) return false;
    const auto [first, last] = by_identity_.equal_range(*identity);
    return std::any_of(first, last,
                       [&](const auto& known) { return are_one_file(known.second, place); });
  }

  void add(const fs::path& file) {
    const std::string place = place_of(file);
    if (const auto identity = identity_of(file)) by_identity_.emplace(*identity, place);
    places_.insert(place);
  }

 private:
  static std::string place_of(const fs::path& file) {
    std::error_code error;
    const fs::path full = fs::absolute(file, error);
    const fs::path place = fs::weakly_canonical(full, error);
    return error ? full.lexically_normal().native() : place.native();
  }

  /// The places of files that were there when they became known.
  std::multimap<Identity, std::string> by_identity_;
  std::unordered_set<std::string> places_;
};

KnownFiles inputs, outputs;

}  // namespace

void note_input(const fs::path& file) {
  std::error_code error;
  if (fs::is_regular_file(file, error)) inputs.add(file);
}

void claim_output(const fs::path& target, const fs::path& place) {
  if (inputs.contains(place)) {
    throw UsageError(target.string() + ": is an input of this command; name another output");
  }
  if (outputs.contains(place)) {
    throw UsageError(target.string() + ": would be written twice; every output needs its own name");
  }
  outputs.add(place);
}

}  // namespace fathom::app
