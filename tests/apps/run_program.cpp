#include "run_program.h"

#include <fcntl.h>
#include <grp.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>

#include "test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

constexpr uid_t nobody = 65534;

void limit(int resource, const std::optional<rlim_t>& value) {
  if (!value) return;
  const rlimit bounds{*value, *value};
  ::setrlimit(resource, &bounds);
}

void redirect(const std::string& file, int flags, int to) {
  const int descriptor = ::open(file.c_str(), flags | O_CLOEXEC, 0666);
  ::dup2(descriptor, to);
}

/// In the child: does not return.
[[noreturn]] void become(const std::vector<std::string>& command, const RunOptions& options) {
  if (::chdir(options.folder.c_str()) != 0) ::_exit(126);
  limit(RLIMIT_FSIZE, options.file_size);
#ifndef FATHOM_SANITIZED  // their shadow memory takes all addresses
  limit(RLIMIT_AS, options.memory);
#endif
  limit(RLIMIT_CPU, options.seconds);
  if (options.as_nobody && ::geteuid() == 0) {
    if (::setgroups(0, nullptr) != 0 || ::setgid(nobody) != 0 || ::setuid(nobody) != 0) {
      ::_exit(126);
    }
  }
  // A test runner in the background ignores SIGINT; the program under test must not inherit that.
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_DFL);
  if (options.prepare) options.prepare();
  std::vector<char*> arguments;
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  ::_exit(127);
}

std::vector<std::string> with_program(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{program_path()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

}  // namespace

std::string program_path() {
  return program("fathom");
}

Outcome run(const std::vector<std::string>& command, const RunOptions& options) {
  const TestFolder streams;
  streams.write("in", options.input);
  const pid_t child = ::fork();
  if (child == 0) {
    redirect(streams / "in", O_RDONLY, STDIN_FILENO);
    redirect(streams / "out", O_WRONLY | O_CREAT, STDOUT_FILENO);
    redirect(streams / "err", O_WRONLY | O_CREAT, STDERR_FILENO);
    become(command, options);
  }
  Outcome outcome;
  outcome.status = wait_for(child);
  outcome.out = streams.read("out");
  outcome.err = streams.read("err");
  return outcome;
}

Outcome run_fathom(const std::vector<std::string>& arguments, const RunOptions& options) {
  return run(with_program(arguments), options);
}

pid_t start_fathom(const std::vector<std::string>& arguments, const RunOptions& options) {
  const std::vector<std::string> command = with_program(arguments);
  const pid_t child = ::fork();
  if (child == 0) {
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
      redirect("/dev/null", O_WRONLY, stream);
    }
    become(command, options);
  }
  return child;
}

int wait_for(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace fathom::test
