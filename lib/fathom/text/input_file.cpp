#include "fathom/text/input_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "fathom/numeric/errors.h"
#include "fathom/text/descriptor.h"
#include "fathom/text/system_failure.h"

namespace fathom::text {
namespace {

/// Files up to this size are read rather than mapped: if another program truncated a mapped file
/// while it is being read, ours would be killed, and below this size memory is no concern.
constexpr std::size_t largest_read = std::size_t{64} << 20;

}  // namespace

InputFile::InputFile(const std::filesystem::path& path) {
  const std::string name = path.string();
  const Descriptor file{name == "-" ? STDIN_FILENO : ::open(name.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number < 0) fail_with_errno(name, "cannot be opened");
  take(file.number, name, name != "-");
}

InputFile::InputFile(const std::filesystem::path& path, const std::vector<Boundary>& boundaries) {
  const Descriptor file{open_confined(path, boundaries)};
  take(file.number, path.string(), true);
}

void InputFile::take(int descriptor, const std::string& name, bool may_be_mapped) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail_with_errno(name, "cannot be examined");
  if (S_ISDIR(status.st_mode)) throw InputError(name + ": is a directory, expected a file");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (S_ISREG(status.st_mode) && size > largest_read && may_be_mapped) {
    void* mapping = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (mapping != MAP_FAILED) {
      mapping_ = mapping;
      bytes_ = {static_cast<const std::byte*>(mapping), size};
      return;
    }
  }
  read(descriptor, S_ISREG(status.st_mode) ? size + 1 : std::size_t{1} << 16, name);
}

void InputFile::read(int descriptor, std::size_t capacity, const std::string& name) {
  buffer_ = std::make_unique_for_overwrite<std::byte[]>(capacity);
  std::size_t filled = 0;
  while (true) {
    if (filled == capacity) {
      auto larger = std::make_unique_for_overwrite<std::byte[]>(2 * capacity);
      std::copy_n(buffer_.get(), filled, larger.get());
      buffer_ = std::move(larger);
      capacity *= 2;
    }
    const ssize_t got = ::read(descriptor, buffer_.get() + filled, capacity - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_with_errno(name, "cannot be read");
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
  }
  bytes_ = {buffer_.get(), filled};
}

InputFile::~InputFile() {
  if (mapping_) ::munmap(mapping_, bytes_.size());
}

}  // namespace fathom::text
