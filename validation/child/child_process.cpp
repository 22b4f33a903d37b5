#include "validation/child/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

#include "fathom/failures/errors.h"

namespace fathom::validation {
namespace {

using Clock = std::chrono::steady_clock;

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(file, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) return;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
}

/// All that comes before `deadline`; nothing where it passes first.
std::optional<std::string> read_all(int file, std::optional<Clock::time_point> deadline) {
  std::string text;
  std::array<char, 65536> part{};
  for (;;) {
    if (deadline) {
      const auto left =
          std::chrono::duration_cast<std::chrono::milliseconds>(*deadline - Clock::now()).count();
      if (left <= 0) return std::nullopt;
      pollfd waiting{file, POLLIN, 0};
      if (::poll(&waiting, 1, static_cast<int>(std::min<std::int64_t>(left, 1000))) <= 0) continue;
    }
    const ssize_t length = ::read(file, part.data(), part.size());
    if (length < 0 && errno == EINTR) continue;
    if (length <= 0) return text;
    text.append(part.data(), static_cast<std::size_t>(length));
  }
}

/// An interrupted program takes its child with it.
void end_with(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it ended before that
}

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw ChildFailure(name + ": " + what);
}

/// The child's side: it never returns.
[[noreturn]] void work_and_exit(const std::function<std::string()>& work, int pipe, pid_t parent,
                                bool has_group) {
  end_with(parent);
  if (has_group) ::setpgid(0, 0);  // so that processes started by it end with it
  write_all(pipe, work());
  ::_exit(0);  // what the work leaves behind goes with the process
}

/// Its status once it has ended.
int status_of(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

[[noreturn]] void refuse_to_start(const std::string& program, int error) {
  throw InputError(program + ": cannot be started: " + std::generic_category().message(error));
}

/// All that comes out of a pipe until nobody has its other end any more.
std::string heard_from(int pipe) {
  std::string text;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t length = ::read(pipe, part.data(), part.size());
    if (length < 0 && errno == EINTR) continue;
    if (length <= 0) return text;
    text.append(part.data(), static_cast<std::size_t>(length));
  }
}

/// Starts a program whose outputs go into `pipe`; 0, or why not.
int start(const std::vector<std::string>& command, int pipe, pid_t& process) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipe, STDERR_FILENO);
  const int error =
      ::posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

std::string bytes_from_child(const std::function<std::string()>& work,
                             const ChildOptions& options) {
  const std::string& name = options.name;
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) fail(name, std::strerror(errno));
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) fail(name, std::strerror(errno));
  if (child == 0) {
    ::close(ends[0]);
    work_and_exit(work, ends[1], parent, options.seconds > 0);
  }

  ::close(ends[1]);
  std::optional<Clock::time_point> deadline;
  if (options.seconds > 0) deadline = Clock::now() + std::chrono::seconds(options.seconds);
  std::optional<std::string> bytes = read_all(ends[0], deadline);
  ::close(ends[0]);
  if (!bytes) {
    ::kill(-child, SIGKILL);
    ::kill(child, SIGKILL);
  }
  const int status = status_of(child);
  if (!bytes) fail(name, "did not end within " + std::to_string(options.seconds) + " seconds");
  if (WIFSIGNALED(status)) {
    fail(name, "ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
                   ::strsignal(WTERMSIG(status)) + ")");
  }
  if (bytes->empty()) fail(name, "ended without an answer");
  return std::move(*bytes);
}

Said run_command(const std::vector<std::string>& command) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse_to_start(command[0], errno);
  pid_t process = 0;
  const int error = start(command, ends[1], process);
  ::close(ends[1]);
  Said said;
  if (error == 0) said.text = heard_from(ends[0]);
  ::close(ends[0]);
  if (error == ENOENT) return {"", 127};
  if (error != 0) refuse_to_start(command[0], error);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  said.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return said;
}

}  // namespace fathom::validation
