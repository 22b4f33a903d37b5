#include "apps/shell/companion.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "fathom/failures/errors.h"

namespace fathom::app {

std::filesystem::path companion_path(std::string_view program) {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::filesystem::path() : self.parent_path() / program;
}

void start_companion(std::string_view program, const std::vector<std::string>& arguments) {
  if (program.find('/') != std::string::npos) return;
  const std::string path = companion_path(program);
  std::error_code error;
  if (path.empty() || !std::filesystem::exists(path, error)) return;

  std::vector<char*> list{const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
  list.push_back(nullptr);
  ::execv(path.c_str(), list.data());
  throw UsageError(fmt::format("{}: {}", path, std::strerror(errno)));
}

namespace {

/// All that can be read from a file descriptor, which is closed.
std::string drained(int descriptor) {
  std::string text;
  char buffer[4096];
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    text.append(buffer, static_cast<std::size_t>(count));
  }
  ::close(descriptor);
  return text;
}

bool ends_well(pid_t process) {
  int status = -1;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

std::optional<std::string> answer_of(const Companion& companion,
                                     const std::vector<std::string>& arguments) {
  const std::string path = companion_path(companion.program);
  std::vector<std::string> words{path};
  if (companion.takes_name()) words.emplace_back(companion.command);
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> list;
  list.reserve(words.size() + 1);
  for (std::string& word : words) list.push_back(word.data());
  list.push_back(nullptr);

  std::error_code error;
  int pipe[2];
  if (path.empty() || !std::filesystem::exists(path, error) || ::pipe2(pipe, O_CLOEXEC) != 0)
    return std::nullopt;
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
  pid_t process = -1;
  const bool started =
      ::posix_spawn(&process, path.c_str(), &actions, nullptr, list.data(), environ) == 0;
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  std::string answer = drained(pipe[0]);
  if (!started || !ends_well(process)) return std::nullopt;
  return answer;
}

std::string not_built(std::string_view what, std::string_view program, std::string_view how) {
  return fmt::format(
      "{} is a separate program, {}, that is not built: 'scripts/fathom {}' in a clone of "
      "Fathom installs its dependencies and builds it",
      what, program, how);
}

}  // namespace fathom::app
