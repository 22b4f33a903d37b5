#include "fathom/files/descriptor.h"

#include <sys/stat.h>

#include "fathom/failures/errors.h"

namespace fathom::files {

FileState state_of(int descriptor, const std::string& name) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail_with_errno(name, "cannot be examined");
  return {static_cast<std::uint64_t>(status.st_size), status.st_mtim};
}

void expect_whole(const FileState& opened, const FileState& now, const std::string& name) {
  if (now.size < opened.size) throw InputError(name + ": has been cut short while it was read");
}

void expect_unchanged(const FileState& opened, const FileState& now, const std::string& name) {
  expect_whole(opened, now, name);
  if (now.size != opened.size || now.written.tv_sec != opened.written.tv_sec ||
      now.written.tv_nsec != opened.written.tv_nsec) {
    throw InputError(name +
                     ": has been written to since it was opened, expected a file that stays as it "
                     "is while it is read");
  }
}

}  // namespace fathom::files
