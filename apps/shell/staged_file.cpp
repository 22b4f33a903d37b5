#include "apps/shell/staged_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/sendfile.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <optional>
#include <system_error>
#include <utility>

#include "apps/shell/output_place.h"
#include "apps/shell/part_files.h"

namespace fathom::app {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(int error) {
  throw std::system_error(error, std::generic_category());
}

std::string path_of(int descriptor) {
  return fmt::format("/proc/self/fd/{}", descriptor);
}

/// False where the file system cannot.
bool change_places(const char* one, const fs::path& other) {
  return ::renameat2(AT_FDCWD, one, AT_FDCWD, other.c_str(), RENAME_EXCHANGE) == 0;
}

/// Each output that waits for its place takes a descriptor; where these run short, as many as the
/// system allows.
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
