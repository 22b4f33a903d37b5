#include "apps/shell/last_resort.h"

#include <gmp.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "apps/shell/part_files.h"
#include "fathom/threads/threads.h"

namespace fathom::app {
namespace {

std::atomic<pid_t> reporter{0};
std::atomic<int> outcome{-1};  ///< the exit status, once it is known
std::atomic<bool> has_reported{false};
std::atomic<bool (*)(Ending) noexcept> decides{nullptr};

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

ExitStatus report_unexpected(const char* what) noexcept {
  if (!may_report()) return internal_error;
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
  if (reporter.compare_exchange_strong(none, self) || none == self) return;
  ::sleep(2);  // its end may wait for this thread's
  ::_exit(unusable_input);
}

bool may_report(Ending ending) noexcept {
  const auto decide = decides.load();
  return decide == nullptr ? !has_reported.exchange(true) : decide(ending);
}

void let_decide(bool (*decide)(Ending) noexcept) noexcept {
  decides = decide;
}

ExitStatus report_out_of_memory() noexcept {
  have_the_last_word();
  if (!may_report()) return unusable_input;
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
  if (!may_report()) return unusable_input;
  say("fathom: error: the system starts no more threads; --threads N asks for fewer\n");
  return unusable_input;
}

void prepare_last_resort() {
  std::set_terminate(end_terminated);
  std::set_new_handler([] { end(report_out_of_memory); });
  mp_set_memory_functions(allocate, reallocate, deallocate);
}

}  // namespace fathom::app
