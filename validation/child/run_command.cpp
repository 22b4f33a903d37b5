#include "validation/child/run_command.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "fathom/failures/errors.h"

extern char** environ;

namespace fathom::validation {
namespace {

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
