#include "apps/shell/write_all.h"

#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "fathom/numeric/errors.h"

namespace fathom::app {

void write_all(int descriptor, const char* data, std::size_t size,
               const std::filesystem::path& target) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor, data, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      fail_with_errno(target, errno);
    }
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

void fail_with_errno(const std::filesystem::path& target, int error) {
  throw OutputError(target.string() + ": " + std::generic_category().message(error));
}

}  // namespace fathom::app
