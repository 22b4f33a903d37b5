#include "faults.h"

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <thread>

#include "sample_files.h"

namespace fathom::test {
namespace {

namespace fs = std::filesystem;

sock_filter statement(int code, std::uint32_t k) {
  return {static_cast<std::uint16_t>(code), 0, 0, k};
}

sock_filter jump(int code, std::uint32_t k, int yes, int no) {
  return {static_cast<std::uint16_t>(code), static_cast<std::uint8_t>(yes),
          static_cast<std::uint8_t>(no), k};
}

/// Goes on behind these where the call is not the one that is refused.
void add(std::vector<sock_filter>& filter, const Refusal& refusal) {
  const auto low_half = offsetof(seccomp_data, args) + 8 * refusal.argument;
  const int rest = refusal.mask == 0 ? 1 : 3;
  filter.push_back(statement(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)));
  filter.push_back(
      jump(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(refusal.call), 0, rest));
  if (refusal.mask != 0) {
    filter.push_back(statement(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(low_half)));
    filter.push_back(jump(BPF_JMP | BPF_JSET | BPF_K, refusal.mask, 0, 1));
  }
  filter.push_back(
      statement(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(refusal.error)));
}

std::function<void()> refusing(std::vector<Refusal> refusals) {
  return [refusals = std::move(refusals)] {
    if (!refuse(refusals)) ::_exit(125);
  };
}

}  // namespace

bool refuse(const std::vector<Refusal>& refusals) {
  std::vector<sock_filter> filter;
  for (const Refusal& refusal : refusals) add(filter, refusal);
  filter.push_back(statement(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

std::function<void()> without_threads() {
  // Without clone3, whose arguments no filter sees, clone is used.
  return refusing({{.call = SYS_clone3, .error = ENOSYS},
                   {.call = SYS_clone, .error = EAGAIN, .argument = 0, .mask = CLONE_THREAD}});
}

std::function<void()> without_nameless_files() {
  return refusing(
      {{.call = SYS_openat, .error = EOPNOTSUPP, .argument = 2, .mask = O_TMPFILE & ~O_DIRECTORY}});
}

std::function<void()> without_links() {
  return refusing({{.call = SYS_linkat, .error = EPERM}});
}

std::function<void()> without_renames() {
  return refusing({{.call = SYS_rename, .error = EIO}});
}

std::function<void()> without_sync() {
  return refusing({{.call = SYS_fsync, .error = EIO}, {.call = SYS_syncfs, .error = EIO}});
}

std::function<void()> without_streams(std::vector<int> streams) {
  return [streams = std::move(streams)] {
    for (const int stream : streams) ::close(stream);
  };
}

namespace {

/// What is staged is locked; what only tells the permissions of a new file is not.
bool is_locked(const fs::path& process, const fs::path& descriptor) {
  std::ifstream info(process / "fdinfo" / descriptor);
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("lock:") && line.find("FLOCK") != std::string::npos) return true;
  }
  return false;
}

}  // namespace

std::string staged_by(pid_t process, const TestFolder& folder) {
  std::error_code error;
  const fs::path about = "/proc/" + std::to_string(process);
  for (fs::directory_iterator at(about / "fd", error), end; !error && at != end;
       at.increment(error)) {
    const std::string target = fs::read_symlink(at->path(), error).string();
    const bool may_be_staged =
        target.starts_with(folder.path().string() + "/") &&
        (target.ends_with(" (deleted)") || target.find("/.fathom-") != std::string::npos);
    if (!error && may_be_staged && is_locked(about, at->path().filename())) return at->path();
  }
  return {};
}

bool wait_until_staged(pid_t process, const TestFolder& folder) {
  while (staged_by(process, folder).empty()) {
    siginfo_t info{};
    if (::waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
        info.si_pid == process) {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

std::string long_work() {
  std::string mesh = square_obj;
  for (int i = 0; i < 5000; ++i) mesh += "f 1 2 3\n";
  return mesh;
}

long lines_of(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

}  // namespace fathom::test
