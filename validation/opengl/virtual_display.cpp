#include "validation/opengl/virtual_display.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "fathom/failures/errors.h"

namespace fathom::validation {
namespace {

constexpr int milliseconds_to_start = 30000;
/// Where Xvfb writes the number of its display.
constexpr int number_file = 3;

/// Xvfb in place of this process. It gets SIGTERM, at which it takes its lock and socket away, when
/// `parent` ends; a group of its own keeps it from being killed together with that.
[[noreturn]] void become_server(int pipe, pid_t parent) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);  // it ended before that
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  if (pipe == number_file) {
    ::fcntl(pipe, F_SETFD, 0);
  } else {
    ::dup2(pipe, number_file);
  }
  ::close_range(number_file + 1, ~0U, 0);  // what others wait for the end of
  ::execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "64x64x24", "-nolisten", "tcp",
           "-noreset", nullptr);
  ::_exit(127);
}

/// The line that comes through `pipe`; empty where none does.
std::string line_of(int pipe) {
  std::string line;
  for (char c = 0;;) {
    pollfd waiting{pipe, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, milliseconds_to_start);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0 || ::read(pipe, &c, 1) != 1) return "";
    if (c == '\n') return line;
    line += c;
  }
}

void end(pid_t server) {
  ::kill(server, SIGTERM);
  while (::waitpid(server, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

VirtualDisplay::VirtualDisplay() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw InputError("Xvfb: cannot be started");
  const pid_t parent = ::getpid();
  server_ = ::fork();
  if (server_ == 0) become_server(ends[1], parent);
  ::close(ends[1]);
  const std::string number = server_ > 0 ? line_of(ends[0]) : "";
  ::close(ends[0]);
  if (number.empty()) {
    if (server_ > 0) end(server_);
    throw InputError("Xvfb: does not start; the package xvfb provides it");
  }
  const char* const display = std::getenv("DISPLAY");
  before_ = display != nullptr ? display : "";
  ::setenv("DISPLAY", (":" + number).c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
  end(server_);
  if (before_.empty()) {
    ::unsetenv("DISPLAY");
  } else {
    ::setenv("DISPLAY", before_.c_str(), 1);
  }
}

}  // namespace fathom::validation
