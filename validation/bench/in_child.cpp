#include "validation/bench/in_child.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <optional>

#include "fathom/numeric/errors.h"

namespace fathom::bench {
namespace {

using Clock = std::chrono::steady_clock;

/// What stands before the text that comes back: how the work ended.
enum class Ending : char { done = 'd', usage = 'u', input = 'i' };

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

std::string labelled(Ending ending, const std::string& text) {
  return static_cast<char>(ending) + text;
}

std::string outcome(const std::function<std::string()>& work) {
  try {
    return labelled(Ending::done, work());
  } catch (const UsageError& error) {
    return labelled(Ending::usage, error.what());
  } catch (const std::bad_alloc&) {
    return labelled(Ending::input, "out of memory");
  } catch (const std::exception& error) {
    return labelled(Ending::input, error.what());
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

}  // namespace

std::string run_in_child(const std::function<std::string()>& work, int seconds,
                         const std::string& name) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) fail(name, std::strerror(errno));
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) fail(name, std::strerror(errno));
  if (child == 0) {
    end_with(parent);
    if (seconds > 0) ::setpgid(0, 0);  // so that what it starts is ended with it
    ::close(ends[0]);
    write_all(ends[1], outcome(work));
    ::_exit(0);  // what the work leaves behind goes with the process
  }

  ::close(ends[1]);
  std::optional<Clock::time_point> deadline;
  if (seconds > 0) deadline = Clock::now() + std::chrono::seconds(seconds);
  std::optional<std::string> text = read_all(ends[0], deadline);
  ::close(ends[0]);
  if (!text) {
    ::kill(-child, SIGKILL);
    ::kill(child, SIGKILL);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!text) fail(name, "did not end within " + std::to_string(seconds) + " seconds");
  if (WIFSIGNALED(status)) {
    fail(name, "ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
                   ::strsignal(WTERMSIG(status)) + ")");
  }
  if (text->empty()) fail(name, "ended without an answer");
  const auto ending = static_cast<Ending>(text->front());
  text->erase(0, 1);
  if (ending == Ending::usage) throw UsageError(*text);
  if (ending == Ending::input) throw InputError(*text);
  return std::move(*text);
}

}  // namespace fathom::bench
