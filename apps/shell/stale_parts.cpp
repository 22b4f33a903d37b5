#include "apps/shell/stale_parts.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <memory>
#include <set>
#include <string>

#include "apps/shell/part_names.h"
#include "fathom/text/descriptor.h"

namespace fathom::app {
namespace {

/// A folder with more entries is not searched to its end: that would take longer than a map.
constexpr int most_entries = 10000;

struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};

/// Removes a part unless someone holds its lock. Its owner locks it and only then looks whether it
/// still has a name, so that a part is lost only before anything is in it. NFS grants such a lock on
/// files that are open for writing alone.
void remove_if_stale(int folder, const char* name) {
  const text::Descriptor file(
      ::openat(folder, name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  struct stat opened {
  }, named{};
  if (!file.is_open() || ::fstat(file.get(), &opened) != 0) return;
  if (!S_ISREG(opened.st_mode) || opened.st_uid != ::geteuid()) return;
  if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) return;
  if (::fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) != 0) return;
  if (named.st_ino == opened.st_ino && named.st_dev == opened.st_dev) ::unlinkat(folder, name, 0);
}

}  // namespace

void remove_stale_parts(const std::filesystem::path& folder) {
  static std::set<std::string> searched;
  if (!searched.insert(folder.native()).second) return;
  const std::unique_ptr<DIR, CloseFolder> open(::opendir(folder.c_str()));
  if (!open) return;
  for (int count = 0; count < most_entries; ++count) {
    const dirent* const entry = ::readdir(open.get());
    if (entry == nullptr) return;
    if (is_part_name(entry->d_name)) remove_if_stale(::dirfd(open.get()), entry->d_name);
  }
}

}  // namespace fathom::app
