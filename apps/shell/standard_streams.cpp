#include "apps/shell/standard_streams.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>

#include "fathom/failures/errors.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

constexpr const char* standard_output = "standard output";

}  // namespace

void open_missing_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // The lowest number that is free is the stream's: those below it are open.
    ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

void expect_writable(int descriptor, const std::string& name) {
  const int flags = ::fcntl(descriptor, F_GETFL);
  if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY) fail_with_errno(name, EBADF);
  pollfd state{descriptor, POLLOUT, 0};
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) fail_with_errno(name, errno);
  const bool is_pipe = S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode);
  if (is_pipe && ::poll(&state, 1, 0) > 0 && (state.revents & (POLLERR | POLLHUP)) != 0) {
    fail_with_errno(name, EPIPE);
  }
  // An empty write to a device already fails if the device is full.
  if (S_ISCHR(status.st_mode) && ::write(descriptor, "", 0) != 0) fail_with_errno(name, errno);
}

void expect_standard_output() {
  expect_writable(STDOUT_FILENO, standard_output);
}

void print(const std::string& text) {
  const std::string shown = text::printable_lines(text);
  write_all(STDOUT_FILENO, shown.data(), shown.size(), standard_output);
}

std::string json_answer(const nlohmann::ordered_json& answer, int indentation) {
  return text::escaped_json(answer.dump(indentation, ' ', false,
                                        nlohmann::ordered_json::error_handler_t::replace)) +
         "\n";
}

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
