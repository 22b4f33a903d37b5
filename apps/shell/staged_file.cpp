#include "apps/shell/staged_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/resource.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "apps/shell/output_file.h"
#include "fathom/failures/errors.h"
#include "fathom/files/descriptor.h"

namespace fathom::app {
namespace {

constexpr std::string_view part_start = ".fathom-", part_end = ".part";

std::uint64_t drawn() {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, GRND_NONBLOCK) == sizeof number) return number;
  // Names must be unique, not secret.
  static std::atomic<std::uint64_t> count{0};
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  return (static_cast<std::uint64_t>(::getpid()) << 40U) ^ static_cast<std::uint64_t>(now) ^
         (++count << 20U);
}

// Global, because a signal handler reaches nothing else.
std::atomic<PendingFile*> first_pending{nullptr};

/// A folder with more entries is not searched completely, because that would take longer than
/// rendering a map.
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

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(int error) {
  throw std::system_error(error, std::generic_category());
}

std::string path_of(int descriptor) {
  return fmt::format("/proc/self/fd/{}", descriptor);
}

/// Returns false if the file system does not support this.
bool change_places(const char* one, const fs::path& other) {
  return ::renameat2(AT_FDCWD, one, AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0;
}

/// Each output that waits for its place uses a descriptor. Raises the limit to the hard limit when
/// descriptors run short.
void make_room_for_more(int descriptor) {
  constexpr rlim_t spare = 64;
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= limit.rlim_max) return;
  if (static_cast<rlim_t>(descriptor) + spare < limit.rlim_cur) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

/// The permissions of a new file in this folder: they depend on the umask or on the folder's
/// default ACL. Found by creating and removing a probe file.
mode_t mode_of_new_file(const fs::path& folder) {
  PendingFile* const name = note_pending(folder / new_part_name());
  const files::Descriptor file(::open(name->path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  const int error = errno;
  struct stat status {};
  if (file.is_open()) ::fstat(file.get(), &status);
  remove_pending(name);
  if (!file.is_open()) fail(error);
  return status.st_mode & 07777;
}

/// Locks a new file under its name. False if another program mistook it for an abandoned file and
/// removes it.
bool is_ours(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

}  // namespace

StagedFile StagedFile::in_folder(const fs::path& folder) {
  remove_stale_parts(folder);
  StagedFile staged;
  if (!staged.open_without_name(folder)) staged.open_with_name(folder);
  make_room_for_more(staged.descriptor());
  return staged;
}

StagedFile StagedFile::nowhere() {
  StagedFile staged;
  std::error_code error;
  const fs::path chosen = fs::temp_directory_path(error);
  for (const fs::path& folder : {chosen, fs::path("/tmp"), fs::path("/var/tmp")}) {
    if (!folder.empty() && staged.open_without_name(folder)) return staged;
  }
  staged.file_ = files::Descriptor(::memfd_create("fathom-output", MFD_CLOEXEC));
  if (staged.file_.is_open() && ::access(staged.path().c_str(), F_OK) == 0) return staged;
  staged.open_with_name(chosen.empty() ? fs::path("/tmp") : chosen);
  return staged;
}

StagedFile::StagedFile(StagedFile&& other) noexcept
    : file_(std::move(other.file_)),
      ordinary_mode_(other.ordinary_mode_),
      name_(std::exchange(other.name_, nullptr)),
      spare_name_(std::exchange(other.spare_name_, nullptr)),
      self_(std::move(other.self_)),
      earlier_(other.earlier_) {}

StagedFile::~StagedFile() {
  if (name_ != nullptr) remove_pending(name_);
  if (spare_name_ != nullptr) forget_pending(spare_name_);
}

bool StagedFile::open_without_name(const fs::path& folder) {
  constexpr int flags = O_TMPFILE | O_RDWR | O_CLOEXEC;
  struct stat ordinary {};
  {
    const files::Descriptor other(::open(folder.c_str(), flags, 0666));
    if (!other.is_open() || ::fstat(other.get(), &ordinary) != 0) return false;
  }
  files::Descriptor file(::open(folder.c_str(), flags, 0600));
  // Without /proc it could neither be opened again nor get a name.
  if (!file.is_open() || ::access(path_of(file.get()).c_str(), F_OK) != 0) return false;
  ordinary_mode_ = ordinary.st_mode & 07777;
  if (::fchmod(file.get(), 0600) != 0) return false;  // whatever the umask has taken away
  // Whoever sees the name that it may have for a moment sees that it is in use.
  ::flock(file.get(), LOCK_EX | LOCK_NB);
  file_ = std::move(file);
  return true;
}

void StagedFile::open_with_name(const fs::path& folder) {
  ordinary_mode_ = mode_of_new_file(folder);
  // A sweeper may take a new file for a stale one before it is locked; but not each time.
  constexpr int most_tries = 100;
  for (int tries = 1;; ++tries) {
    PendingFile* const name = note_pending(folder / new_part_name());
    files::Descriptor file(::open(name->path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
    const int error = file.is_open() ? EBUSY : errno;
    if (file.is_open() && is_ours(file.get()) && ::fchmod(file.get(), 0600) == 0) {
      file_ = std::move(file);
      name_ = name;
      return;
    }
    if (file.is_open()) {
      remove_pending(name);
    } else {
      forget_pending(name);
    }
    if (tries == most_tries || (error != EEXIST && error != EBUSY)) fail(error);
  }
}

std::string StagedFile::path() const {
  return name_ != nullptr ? std::string(name_->path) : path_of(descriptor());
}

void StagedFile::prepare_for(const fs::path& place) {
  if (name_ != nullptr || spare_name_ != nullptr) return;
  self_ = path_of(descriptor());
  spare_name_ = note_pending(place.parent_path() / new_part_name());
}

/// False where something is there already, or a file without a name cannot get one.
bool StagedFile::link_to(const char* place) const {
  return ::linkat(AT_FDCWD, self_.c_str(), AT_FDCWD, place, AT_SYMLINK_FOLLOW) == 0;
}

/// A link cannot replace a file: it first gets a name next to that file.
void StagedFile::have_name(const fs::path& place) {
  if (name_ != nullptr) return;
  if (link_to(spare_name_->path)) {
    name_ = std::exchange(spare_name_, nullptr);
    return;
  }
  // Some systems let a file have no name, and then refuse to give it one.
  StagedFile copy;
  copy.open_with_name(folder_of(place));
  copy_to(copy);
  file_ = std::move(copy.file_);
  name_ = std::exchange(copy.name_, nullptr);
}

void StagedFile::put_at(const fs::path& place) {
  prepare_for(place);
  if (name_ == nullptr && link_to(place.c_str())) return;
  have_name(place);
  rename_to(place);
}

void StagedFile::rename_to(const fs::path& place) {
  if (::rename(name_->path, place.c_str()) != 0) fail(errno);
  forget_pending(std::exchange(name_, nullptr));
}

void StagedFile::put_for_now_at(const fs::path& place) {
  earlier_ = Earlier::nothing;
  prepare_for(place);
  if (name_ == nullptr && link_to(place.c_str())) return;
  have_name(place);
  struct stat status {};
  const bool is_free = ::lstat(place.c_str(), &status) != 0 && errno == ENOENT;
  if (!is_free && S_ISREG(status.st_mode) && change_places(name_->path, place)) {
    earlier_ = Earlier::kept;
    return;
  }
  earlier_ = is_free ? Earlier::nothing : Earlier::lost;
  rename_to(place);
}

void StagedFile::take_back_from(const fs::path& place) noexcept {
  if (earlier_ == Earlier::nothing) ::unlink(place.c_str());
  if (earlier_ == Earlier::kept) change_places(name_->path, place);
  earlier_ = Earlier::lost;
}

void StagedFile::copy_to(const StagedFile& other) const {
  struct stat status {};
  if (::fstat(descriptor(), &status) != 0) fail(errno);
  off_t at = 0;
  while (at < status.st_size) {
    const ssize_t copied = ::sendfile(other.descriptor(), descriptor(), &at,
                                      static_cast<std::size_t>(status.st_size - at));
    if (copied < 0 && errno == EINTR) continue;
    if (copied <= 0) fail(copied == 0 ? EIO : errno);
  }
  if (::fchown(other.descriptor(), status.st_uid, status.st_gid) != 0) errno = 0;
  if (::fchmod(other.descriptor(), status.st_mode & 07777) != 0) fail(errno);
  if (::fsync(other.descriptor()) != 0 && errno != EINVAL) fail(errno);
}

}  // namespace fathom::app
