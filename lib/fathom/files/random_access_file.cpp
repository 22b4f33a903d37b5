#include "fathom/files/random_access_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "fathom/failures/errors.h"
#include "fathom/files/descriptor.h"

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

bool ByteWindow::read_on(std::size_t count) {
  const auto kept = static_cast<std::size_t>(end_ - at_);
  if (kept + unread_ < count) return false;
  std::memmove(buffer_.data(), at_, kept);
  const auto more =
      static_cast<std::size_t>(std::min<std::uint64_t>(buffer_.size() - kept, unread_));
  file_->read(end_offset_, std::as_writable_bytes(std::span(buffer_).subspan(kept, more)));
  at_ = buffer_.data();
  end_ = at_ + kept + more;
  end_offset_ += more;
  unread_ -= more;
  return true;
}

void ByteWindow::skip(std::uint64_t count) {
  const auto here = std::min<std::uint64_t>(count, static_cast<std::uint64_t>(end_ - at_));
  at_ += here;
  unread_ -= count - here;
  end_offset_ += count - here;
}

FileBlocks::FileBlocks(const RandomAccessFile& file)
    : file_(file), blocks_(std::make_unique<std::array<Block, block_count>>()) {}

void FileBlocks::load(Block& block, std::uint64_t number) const {
  block.number = UINT64_MAX;  // until the block is complete
  const std::uint64_t begin = number * block_size;
  const std::uint64_t there = file_.size() > begin ? file_.size() - begin : 0;
  const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(there, block_size));
  file_.read(begin, std::span(block.bytes).first(size));
  block.number = number;
}

void FileBlocks::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  if (offset > file_.size() || bytes.size() > file_.size() - offset) {
    file_.read(offset, bytes);  // fails, with the place where the file ends
    return;
  }
  while (!bytes.empty()) {
    const std::uint64_t number = offset / block_size;
    const auto within = static_cast<std::size_t>(offset % block_size);
    const std::size_t size = std::min(bytes.size(), block_size - within);
    Block& block = (*blocks_)[number % block_count];
    {
      const std::lock_guard lock(block.mutex);
      if (block.number != number) load(block, number);
      std::memcpy(bytes.data(), block.bytes.data() + within, size);
    }
    bytes = bytes.subspan(size);
    offset += size;
  }
}

}  // namespace fathom::files
