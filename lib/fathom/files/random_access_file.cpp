#include "fathom/files/random_access_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "fathom/failures/errors.h"
#include "fathom/files/system_failure.h"

namespace fathom::files {

RandomAccessFile::RandomAccessFile(const std::filesystem::path& path) : name_(path.string()) {
  struct stat status {};
  if (::stat(name_.c_str(), &status) != 0) fail_with_errno(name_, "cannot be opened");
  if (S_ISDIR(status.st_mode)) throw InputError(name_ + ": is a directory, expected a file");
  if (!S_ISREG(status.st_mode)) {
    throw InputError(name_ + ": is not a regular file, expected a file that can be read in parts");
  }
  descriptor_ = ::open(name_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail_with_errno(name_, "cannot be opened");
  opened_ = state_of(descriptor_, name_);
}

RandomAccessFile::~RandomAccessFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void RandomAccessFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t got =
        ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_with_errno(name_, "cannot be read");
    if (got == 0) {
      throw InputError(name_ + ": byte " + std::to_string(offset) +
                       ": the file ends, expected the " + std::to_string(opened_.size) +
                       " bytes that it had when it was opened");
    }
    bytes = bytes.subspan(static_cast<std::size_t>(got));
    offset += static_cast<std::uint64_t>(got);
  }
}

void RandomAccessFile::expect_unchanged() const {
  files::expect_unchanged(opened_, state_of(descriptor_, name_), name_);
}

}  // namespace fathom::files
