#include "fathom/files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <system_error>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/files/descriptor.h"
#include "fathom/files/input_stream.h"
#include "fathom/memory/huge_pages.h"
#include "fathom/threads/interruption.h"

namespace fathom::files {
namespace {

bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto [in_folder, in_file] =
      std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
  return in_folder == folder.end() && in_file != file.end();
}

/// The path of an open file, without symbolic links.
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

namespace {

/// Files up to this size are always read: below it memory is no concern.
constexpr std::size_t largest_read = std::size_t{64} << 20;

/// Between such pieces the reading can be interrupted.
constexpr std::size_t read_at_once = std::size_t{32} << 20;

}  // namespace

InputFile::InputFile(const std::filesystem::path& path, Reading reading) : name_(path.string()) {
  if (name_ == "-") {
    take(Descriptor(::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0)), Reading::copied);
  } else {
    take(open_input(name_), reading);
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
