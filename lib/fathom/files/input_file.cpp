#include "fathom/files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/files/descriptor.h"
#include "fathom/memory/huge_pages.h"
#include "fathom/threads/interruption.h"

namespace fathom::files {
namespace {

/// Files up to this size are always read: below it memory is no concern.
constexpr std::size_t largest_read = std::size_t{64} << 20;

/// Between such pieces the reading can be interrupted.
constexpr std::size_t read_at_once = std::size_t{32} << 20;

bool is_device(const struct stat& status) {
  return S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode);
}

/// Whether a device is /dev/null, which is empty, or the one that standard input is: a terminal.
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

Descriptor opened(const std::string& name) {
  refuse_folders_and_devices(name);
  Descriptor file(::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY));
  if (!file.is_open()) fail_with_errno(name, "cannot be opened");
  return file;
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path, Reading reading) : name_(path.string()) {
  if (name_ == "-") {
    take(Descriptor(::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)), Reading::copied);
  } else {
    take(opened(name_), reading);
  }
}

InputFile::InputFile(const std::filesystem::path& path, const std::vector<Boundary>& boundaries,
                     Reading reading)
    : name_(path.string()) {
  take(open_confined(path, boundaries), reading);
}

void InputFile::take(Descriptor file, Reading reading) {
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail_with_errno(name_, "cannot be examined");
  if (S_ISDIR(status.st_mode)) throw InputError(name_ + ": is a directory, expected a file");
  if (!S_ISREG(status.st_mode)) return read(file.get(), 0);
  opened_ = state_of(file.get(), name_);
  const auto size = static_cast<std::size_t>(opened_.size);
  if (size > largest_read && reading == Reading::mapped_where_large) {
    mapped_ = MappedFile(file.get(), 0, size, name_);
    bytes_ = {mapped_.data(), size};
    if (mapped_.is_mapped()) {
      file_ = std::move(file);
      return;
    }
  }
  read(file.get(), size);
  read_ = state_of(file.get(), name_);
  expect_whole(opened_, read_, name_);
}

void InputFile::expect_unchanged() const {
  files::expect_unchanged(opened_, mapped_.is_mapped() ? state_of(file_.get(), name_) : read_,
                          name_);
}

void InputFile::resize(std::size_t capacity) {
  // Large blocks move without being copied.
  auto* const bytes = static_cast<std::byte*>(std::realloc(buffer_.get(), capacity));
  if (bytes == nullptr) throw std::bad_alloc();
  static_cast<void>(buffer_.release());
  buffer_.reset(bytes);
  memory::prefer_huge_pages(bytes, capacity);
}

void InputFile::read(int descriptor, std::uint64_t size) {
  // One byte more than the file has, so that its end is reached without growing.
  const std::uint64_t most = std::max(size, largest_unsized_input) + 1;
  std::size_t capacity = size > 0 ? static_cast<std::size_t>(size) + 1 : std::size_t{1} << 16;
  std::size_t filled = 0;
  resize(capacity);
  while (true) {
    if (filled == most) {
      throw InputError(name_ + ": has no end after " + std::to_string(most - 1) +
                       " bytes, the limit of inputs that are not regular files; expected a file");
    }
    if (filled == capacity) {
      capacity = static_cast<std::size_t>(std::min<std::uint64_t>(2 * capacity, most));
      resize(capacity);
    }
    check_interruption();
    const ssize_t got =
        ::read(descriptor, buffer_.get() + filled, std::min(capacity - filled, read_at_once));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_with_errno(name_, "cannot be read");
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
  }
  bytes_ = {buffer_.get(), filled};
}

std::filesystem::path folder_of_input(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(path, error).type();
  const bool lies_nowhere = type == std::filesystem::file_type::fifo ||
                            type == std::filesystem::file_type::socket ||
                            type == std::filesystem::file_type::character;
  return lies_nowhere ? std::filesystem::path() : path.parent_path();
}

}  // namespace fathom::files
