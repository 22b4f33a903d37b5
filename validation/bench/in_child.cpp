#include "validation/bench/in_child.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <new>

#include "fathom/numeric/errors.h"

namespace fathom::bench {
namespace {

/// What stands before the text that comes back: how the work ended.
enum class Ending : char { done = 'd', usage = 'u', input = 'i' };

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(file, text.data() + done, text.size() - done);
    if (written < 0 && errno != EINTR) return;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
}

std::string read_all(int file) {
  std::string text;
  std::array<char, 4096> part{};
  for (;;) {
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

[[noreturn]] void fail(const std::string& what) {
  throw InputError("a process to measure in: " + what);
}

}  // namespace

std::string run_in_child(const std::function<std::string()>& work) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) fail(std::strerror(errno));
  const pid_t child = ::fork();
  if (child < 0) fail(std::strerror(errno));
  if (child == 0) {
    ::close(ends[0]);
    write_all(ends[1], outcome(work));
    ::_exit(0);  // what the work leaves behind goes with the process
  }

  ::close(ends[1]);
  std::string text = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) {
    fail("ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
         ::strsignal(WTERMSIG(status)) + ")");
  }
  if (text.empty()) fail("ended without an answer");
  const auto ending = static_cast<Ending>(text.front());
  text.erase(0, 1);
  if (ending == Ending::usage) throw UsageError(text);
  if (ending == Ending::input) throw InputError(text);
  return text;
}

}  // namespace fathom::bench
