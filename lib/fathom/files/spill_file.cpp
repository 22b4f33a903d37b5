#include "fathom/files/spill_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "fathom/failures/errors.h"

namespace fathom::files {
namespace fs = std::filesystem;

namespace {

template <class Failure>
[[noreturn]] void fail(const std::string& name, int error) {
  throw Failure(name + ": " + std::generic_category().message(error));
}

/// Some file systems have no files without a name; there, it is taken away at once.
Descriptor open_unnamed(const fs::path& folder) {
#ifdef O_TMPFILE
  const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0) return Descriptor(file);
#endif
  std::string name = (folder / ".fathom-XXXXXX").string();
  Descriptor named(::mkostemp(name.data(), O_CLOEXEC));
  if (!named.is_open()) fail<OutputError>(folder.string(), errno);
  ::unlink(name.c_str());
  return named;
}

fs::path folder_or_default(fs::path folder) {
  if (!folder.empty()) return folder;
  std::error_code error;
  fs::path given = fs::temp_directory_path(error);
  if (error) throw OutputError("TMPDIR: expected a folder: " + error.message());
  return given;
}

/// Calls transfer(offset, bytes left) until none is left; it returns how many it has done.
template <class Failure, class Span, class Transfer>
void transfer_all(const std::string& name, std::uint64_t offset, Span bytes,
                  const Transfer& transfer) {
  while (!bytes.empty()) {
    const ssize_t done = transfer(static_cast<off_t>(offset), bytes);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) fail<Failure>(name, done < 0 ? errno : EIO);
    offset += static_cast<std::uint64_t>(done);
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
}

}  // namespace

SpillFile::SpillFile(fs::path folder)
    : name_(folder_or_default(std::move(folder)).string()), file_(open_unnamed(name_)) {
  name_ += " (what does not fit into memory)";
}

std::uint64_t SpillFile::append(ByteView bytes) {
  const std::uint64_t offset = size_.fetch_add(bytes.size());
  write(offset, bytes);
  return offset;
}

void SpillFile::write(std::uint64_t offset, ByteView bytes) {
  transfer_all<OutputError>(name_, offset, bytes, [&](off_t at, ByteView left) {
    return ::pwrite(file_.get(), left.data(), left.size(), at);
  });
}

void SpillFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
  transfer_all<InputError>(name_, offset, bytes, [&](off_t at, std::span<std::byte> left) {
    return ::pread(file_.get(), left.data(), left.size(), at);
  });
}

}  // namespace fathom::files
