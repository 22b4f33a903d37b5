#include "fathom/mesh_files/formats_program/process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "fathom/failures/errors.h"

namespace fathom::mesh_files::formats_program {
namespace {

constexpr const char* program_name = "fathom-formats";
constexpr std::uint64_t mebibyte = std::uint64_t{1} << 20;

/// It is next to the running program, in the build folder and when installed.
std::filesystem::path beside_this_program() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / program_name;
}

std::filesystem::path find_program(const ReadOptions& options, const std::string& file) {
  std::filesystem::path path =
      options.formats_program ? options.formats_program() : beside_this_program();
  std::error_code error;
  if (std::filesystem::exists(path, error)) return path;
  throw InputError(
      file + ": is read by a separate program, " + program_name +
      ", that is not installed: the package fathom contains it; 'scripts/fathom formats' "
      "in a clone of Fathom builds it");
}

/// Both ends close themselves in programs that this process starts.
std::array<int, 2> socket_pair(const std::string& program) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw InputError(program + ": " + std::generic_category().message(errno));
  return ends;
}

/// The program starts with the socket as standard input, without output, and without any other open
/// file of this process. (The output of a library must not mix with the one line of a failure.)
struct StartActions {
  posix_spawn_file_actions_t files{};
  posix_spawnattr_t attributes{};

  explicit StartActions(int socket) {
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_adddup2(&files, socket, STDIN_FILENO);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
      ::posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
    ::posix_spawnattr_init(&attributes);
    sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  StartActions(const StartActions&) = delete;
  StartActions& operator=(const StartActions&) = delete;
  ~StartActions() {
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
  }
};

/// What became of the program, by its status.
std::string ending(int status, const Limits& limits, const std::string& program) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == other_version)
    return program +
           " belongs to another version: install the package fathom of this version, or build it "
           "again by "
           "'scripts/fathom formats' in a clone of Fathom";
  if (!WIFSIGNALED(status)) return program + " does not answer";
  switch (const int signal = WTERMSIG(status)) {
    case SIGXCPU:
    case SIGALRM:
      return "it takes more than " + std::to_string(limits.seconds) + " s";
    case SIGKILL:
      return "it was killed, for want of memory or by a user";
    default:
      return std::string("it crashed (") + ::strsignal(signal) + ")";
  }
}

}  // namespace

Limits limits_of(std::uint64_t bytes, std::uint64_t max_expansion) {
  // 16 GiB of a file, and a millionfold expansion, are far from an overflow.
  const std::uint64_t size = std::min(bytes, std::uint64_t{1} << 34);
  const std::uint64_t factor = std::min<std::uint64_t>(max_expansion, 1'000'000);
  return {.memory = 128 * mebibyte + factor * (8 * mebibyte + 4 * size),
          .seconds = static_cast<std::uint32_t>(5 + factor * (4 + size / mebibyte) / 16)};
}

Process::Process(const ReadOptions& options, const std::string& file)
    : program_(find_program(options, file)), max_expansion_(options.max_expansion) {
  const auto [here, there] = socket_pair(program_);
  const StartActions actions(there);
  std::string name = program_, task(serve), version(message_version);
  char* const arguments[] = {name.data(), task.data(), version.data(), nullptr};
  const int error = ::posix_spawn(&process_, program_.c_str(), &actions.files, &actions.attributes,
                                  arguments, environ);
  ::close(there);
  if (error == 0) {
    socket_ = here;
    return;
  }
  ::close(here);
  throw InputError(file + ": is read by " + program_.string() +
                   ", which cannot be started: " + std::generic_category().message(error));
}

/// Nothing more will be asked, so nothing is lost where the program is still at work.
Process::~Process() {
  ::close(socket_);
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::vector<std::byte> Process::ask(Task task, std::span<const std::byte> parameters,
                                    std::span<const std::byte> bytes, ExpansionBudget& budget) {
  const Limits limits = limits_of(bytes.size(), max_expansion_);
  const RequestHead request{task, limits.seconds, limits.memory, parameters.size(), bytes.size()};
  ReplyHead reply;
  if (!send_all(socket_, std::as_bytes(std::span(&request, 1))) || !send_all(socket_, parameters) ||
      !send_all(socket_, bytes) ||
      !receive_all(socket_, std::as_writable_bytes(std::span(&reply, 1))))
    fail_as_ended(limits);
  budget.take(reply.bytes, 1);
  std::vector<std::byte> answer(reply.bytes);
  if (!receive_all(socket_, answer)) fail_as_ended(limits);
  if (reply.refused == 0) return answer;
  throw Refusal({reinterpret_cast<const char*>(answer.data()), answer.size()});
}

void Process::fail_as_ended(const Limits& limits) {
  int status = 0;
  pid_t ended = -1;
  do {
    ended = ::waitpid(process_, &status, 0);
  } while (ended < 0 && errno == EINTR);
  process_ = -1;
  throw Refusal(ended < 0 ? program_.string() + " does not answer"
                          : ending(status, limits, program_));
}

}  // namespace fathom::mesh_files::formats_program
