#include "fathom/files/input_stream.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "fathom/failures/errors.h"
#include "fathom/threads/interruption.h"

namespace fathom::files {
namespace {

bool is_device(const struct stat& status) {
  return S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode);
}

/// Whether a device is /dev/null, which is empty, or standard input, such as a terminal.
bool is_harmless(const struct stat& status) {
  struct stat standard {};
  const bool is_standard_input = ::fstat(STDIN_FILENO, &standard) == 0 && is_device(standard) &&
                                 standard.st_rdev == status.st_rdev;
  return is_standard_input || (S_ISCHR(status.st_mode) && status.st_rdev == ::makedev(1, 3));
}

/// Checked before opening, because merely opening some devices has side effects.
void refuse_folders_and_devices(const std::string& name) {
  struct stat status {};
  if (::stat(name.c_str(), &status) != 0) fail_with_errno(name, "cannot be opened");
  if (S_ISDIR(status.st_mode)) throw InputError(name + ": is a directory, expected a file");
  if (is_device(status) && !is_harmless(status)) {
    throw InputError(name + ": is a device, expected a file or a pipe");
  }
}

}  // namespace

Descriptor open_input(const std::string& name) {
  refuse_folders_and_devices(name);
  Descriptor file(::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
  if (!file.is_open()) fail_with_errno(name, "cannot be opened");
  return file;
}

InputStream::InputStream(const std::filesystem::path& path)
    : name_(path.string()),
      file_(name_ == "-" ? Descriptor(::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0))
                         : open_input(name_)) {
  struct stat status {};
  if (::fstat(file_.get(), &status) != 0) fail_with_errno(name_, "cannot be examined");
  if (S_ISDIR(status.st_mode)) throw InputError(name_ + ": is a directory, expected a file");
  if (!S_ISREG(status.st_mode)) return;
  opened_ = state_of(file_.get(), name_);
  const off_t here = ::lseek(file_.get(), 0, SEEK_CUR);
  rest_ =
      opened_.size - std::min(opened_.size, static_cast<std::uint64_t>(std::max<off_t>(here, 0)));
}

std::size_t InputStream::read(std::span<std::byte> bytes) {
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    check_interruption();
    const ssize_t got = ::read(file_.get(), &bytes[filled], bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_with_errno(name_, "cannot be read");
    if (got == 0) {
      if (rest_) expect_unchanged(opened_, state_of(file_.get(), name_), name_);
      break;
    }
    filled += static_cast<std::size_t>(got);
  }
  if (rest_) *rest_ -= std::min<std::uint64_t>(*rest_, filled);
  return filled;
}

}  // namespace fathom::files
