#include "apps/shell/known_files.h"

#include <sys/stat.h>

#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>

#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

namespace fs = std::filesystem;

/// Files, known by what they are on their device and by where they lie: a new file has only a
/// place, and a hard link only the file in common with another.
class KnownFiles {
 public:
  [[nodiscard]] bool contains(const fs::path& file) const {
    const auto identity = identity_of(file);
    if (identity && identities_.contains(*identity)) return true;
    return places_.contains(place_of(file));
  }

  void add(const fs::path& file) {
    if (const auto identity = identity_of(file)) identities_.insert(*identity);
    places_.insert(place_of(file));
  }

 private:
  using Identity = std::pair<dev_t, ino_t>;

  static std::optional<Identity> identity_of(const fs::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) return std::nullopt;
    return Identity{status.st_dev, status.st_ino};
  }

  static std::string place_of(const fs::path& file) {
    std::error_code error;
    const fs::path full = fs::absolute(file, error);
    const fs::path place = fs::weakly_canonical(full, error);
    return error ? full.lexically_normal().native() : place.native();
  }

  std::set<Identity> identities_;
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
