#include "apps/shell/last_resort.h"

#include <fcntl.h>
#include <gmp.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <optional>

#include "apps/shell/pending_files.h"
#include "fathom/threads/threads.h"

namespace fathom::app {
namespace {

std::atomic<pid_t> speaker{0};
std::atomic<int> outcome{-1};  ///< the exit status, once it is known
std::atomic<Speaks> speaks_now{Speaks::of_all};
/// The file that is made by the process that speaks; "" if there is none.
std::array<char, 512> last_word_path{};
std::atomic<std::atomic<int>*> said_by_any{nullptr};

/// A line on standard error, without stdio, which might need memory or hold a lock.
void say(const char* text) noexcept {
  std::size_t size = std::strlen(text);
  while (size > 0) {
    const ssize_t written = ::write(STDERR_FILENO, text, size);
    if (written <= 0) return;
    text += written;
    size -= static_cast<std::size_t>(written);
  }
}

/// Whether this process is the first to make the file; nullopt where none can be made.
std::optional<bool> makes_last_word_file() noexcept {
  if (last_word_path[0] == '\0') return std::nullopt;
  const int file = ::open(last_word_path.data(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0600);
  if (file >= 0) {
    ::close(file);
    return true;
  }
  return errno == EEXIST ? std::optional(false) : std::nullopt;
}

ExitStatus report_unexpected(const char* what) noexcept {
  if (!may_speak()) return internal_error;
  say("fathom: error: unexpected: ");
  say(what);
  say("\n");
  return internal_error;
}

template <class Report>
[[noreturn]] void end(const Report& report) noexcept {
  if (const int known = outcome; known >= 0) ::_exit(known);
  have_the_last_word();
  remove_all_pending();
  ::_exit(report());
}

[[noreturn]] void end_terminated() noexcept {
  try {
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc&) {
    end(report_out_of_memory);
  } catch (const std::exception& failure) {
    if (is_lack_of_threads(failure)) end(report_lack_of_threads);
    end([&] { return report_unexpected(failure.what()); });
  } catch (...) {
  }
  end([] { return report_unexpected("std::terminate was called"); });
}

std::array<char, 120> memory_limit{};

void* allocate(std::size_t size) {
  void* block = std::malloc(size);
  if (block == nullptr) end(report_out_of_memory);
  return block;
}

void* reallocate(void* block, std::size_t, std::size_t size) {
  void* larger = std::realloc(block, size);
  if (larger == nullptr) end(report_out_of_memory);
  return larger;
}

void deallocate(void* block, std::size_t) {
  std::free(block);
}

}  // namespace

void have_the_last_word() noexcept {
  const pid_t self = ::gettid();
  pid_t none = 0;
  if (speaker.compare_exchange_strong(none, self) || none == self) return;
  ::sleep(2);  // its end may wait for this thread's
  ::_exit(unusable_input);
}

void speak(Speaks speaks) noexcept {
  speaks_now = speaks;
}

void share_last_word(const std::string& path) {
  if (path.size() < last_word_path.size()) path.copy(last_word_path.data(), path.size());
}

void share_last_word(std::atomic<int>* said) noexcept {
  said_by_any = said;
}

bool may_speak(Speaks of) noexcept {
  Speaks now = speaks_now;
  do {
    if (now < of) return false;
  } while (!speaks_now.compare_exchange_weak(now, Speaks::of_nothing));
  if (const std::optional<bool> first = makes_last_word_file()) return *first;
  std::atomic<int>* const said = said_by_any;
  return said == nullptr || said->exchange(1) == 0;
}

ExitStatus report_out_of_memory() noexcept {
  have_the_last_word();
  if (!may_speak()) return unusable_input;
  say("fathom: error: out of memory: the input or the image is too large");
  say(memory_limit.data());
  say("\n");
  return unusable_input;
}

void name_memory_limit(const char* text) noexcept {
  std::snprintf(memory_limit.data(), memory_limit.size(), "; %s", text);
}

int outcome_is(int status) noexcept {
  outcome = status;
  return status;
}

ExitStatus report_lack_of_threads() noexcept {
  have_the_last_word();
  if (!may_speak()) return unusable_input;
  say("fathom: error: the system starts no more threads; --threads N asks for fewer\n");
  return unusable_input;
}

void prepare_last_resort() {
  std::set_terminate(end_terminated);
  std::set_new_handler([] { end(report_out_of_memory); });
  mp_set_memory_functions(allocate, reallocate, deallocate);
}

}  // namespace fathom::app
