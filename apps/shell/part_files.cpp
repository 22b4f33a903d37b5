#include "apps/shell/part_files.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <set>

#include "fathom/failures/errors.h"
#include "fathom/files/descriptor.h"

namespace fathom::app {
namespace {

constexpr std::string_view part_start = ".fathom-", part_end = ".part";

std::uint64_t drawn() {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, GRND_NONBLOCK) == sizeof number) return number;
  // Names need to differ, not to be secret.
  static std::atomic<std::uint64_t> count{0};
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  return (static_cast<std::uint64_t>(::getpid()) << 40U) ^ static_cast<std::uint64_t>(now) ^
         (++count << 20U);
}

// Global, as a signal handler reaches nothing else.
std::atomic<PendingFile*> first_pending{nullptr};

/// A folder with more entries is not searched to its end: that would take longer than a map.
constexpr int most_entries = 10000;

struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};

/// Removes a part unless a process holds its lock. The owner locks the part and then checks whether
/// it still has a name, so that a part can be lost only while it is empty. NFS grants such a lock
/// only on files that are open for writing.
void remove_if_stale(int folder, const char* name) {
  const files::Descriptor file(
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

std::string new_part_name() {
  return fmt::format("{}{:016x}{}", part_start, drawn(), part_end);
}

bool is_part_name(std::string_view name) {
  if (!name.starts_with(part_start) || !name.ends_with(part_end)) return false;
  name.remove_prefix(part_start.size());
  if (name.size() != 16 + part_end.size()) return false;
  return std::all_of(name.begin(), name.begin() + 16,
                     [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

PendingFile* note_pending(const std::filesystem::path& path) {
  const std::string& text = path.native();
  if (text.size() >= PATH_MAX) throw OutputError(text + ": the name is too long");
  PendingFile* file = first_pending.load();
  while (file != nullptr && file->active.load()) file = file->next;
  const bool fresh = file == nullptr;
  if (fresh) file = new PendingFile;
  std::memcpy(file->path, text.c_str(), text.size() + 1);
  file->owner = ::getpid();
  file->active.store(true);
  if (fresh) {
    file->next = first_pending.load();
    first_pending.store(file);
  }
  return file;
}

void forget_pending(PendingFile* file) {
  file->active.store(false);
}

void remove_pending(PendingFile* file) {
  ::unlink(file->path);
  forget_pending(file);
}

void remove_all_pending() {
  const pid_t self = ::getpid();
  for (PendingFile* file = first_pending.load(); file != nullptr; file = file->next) {
    if (file->active.load() && file->owner == self) ::unlink(file->path);
  }
}

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
