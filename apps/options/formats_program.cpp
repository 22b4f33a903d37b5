#include "apps/options/formats_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

#include "apps/shell/companion.h"

namespace fathom::app {
namespace {

/// Whether it came to an end does not matter: whoever needs what it provides looks for that.
void run_to_its_end(char* program) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  // A mesh may stand on standard input.
  ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  char* const arguments[] = {program, nullptr};
  pid_t child = -1;
  const int error = ::posix_spawn(&child, program, &actions, nullptr, arguments, environ);
  ::posix_spawn_file_actions_destroy(&actions);
  while (error == 0 && ::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

std::filesystem::path formats_program() {
  std::filesystem::path path = companion_path("fathom-formats");
  std::error_code error;
  if (std::filesystem::exists(path, error)) return path;
  if (char* const provider = std::getenv("FATHOM_PROVIDE_FORMATS")) run_to_its_end(provider);
  return path;
}

}  // namespace fathom::app
