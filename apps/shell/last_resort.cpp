#include "apps/shell/last_resort.h"

#include <gmp.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <utility>

#include "apps/shell/staged_file.h"
#include "fathom/failures/failure_kind.h"
#include "fathom/files/mapped_file.h"

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
    if (kind_of(failure) == FailureKind::threads) end(report_lack_of_threads);
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

// Signals. Handlers call only async-signal-safe functions.

constexpr std::array interruptions{SIGINT, SIGTERM, SIGHUP};
constexpr std::array endings{SIGQUIT, SIGALRM,   SIGVTALRM, SIGPROF, SIGUSR1,
                             SIGUSR2, SIGSTKFLT, SIGIO,     SIGPWR,  SIGXCPU};
constexpr std::array crashes{SIGSEGV, SIGABRT, SIGFPE, SIGILL, SIGBUS, SIGSYS, SIGTRAP};

/// The previous action of a crash, so that a sanitizer still reports its failed checks.
std::array<struct sigaction, NSIG> action_before{};

/// Of handlers that do not return. Before such a call the address sanitizer asks for the bounds of
/// the stack, which takes a lock: a signal within that very question would wait for ever.
#define FATHOM_NOT_ADDRESS_SANITIZED __attribute__((no_sanitize("address")))

/// Two, so that one is whole at any time. The second of them is written while the first is said.
struct LastWords {
  std::array<char, 256> texts[2]{};
  std::atomic<int> current{0};
};
LastWords last_words;

extern "C" FATHOM_NOT_ADDRESS_SANITIZED void remove_and_exit(int) {
  remove_all_pending();
  const char* const text = last_words.texts[last_words.current.load()].data();
  if (*text != '\0' && may_report(Ending::interruption)) say(text);
  ::_exit(interrupted);
}

/// Ends the program by the signal, which comes again as soon as the handler returns.
extern "C" void remove_and_end(int signal) {
  remove_all_pending();
  sigaction(signal, &action_before[static_cast<std::size_t>(signal)], nullptr);
  ::raise(signal);
}

extern "C" FATHOM_NOT_ADDRESS_SANITIZED void report_or_end(int signal, siginfo_t* info, void*) {
  const char* const file = info->si_code > 0 ? files::mapped_file_at(info->si_addr) : nullptr;
  if (file == nullptr) return remove_and_end(signal);
  remove_all_pending();
  if (may_report()) {
    say("fathom: error: ");
    say(file);
    say(": has been cut short while it was read\n");
  }
  ::_exit(unusable_input);
}

struct sigaction action_of(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_ONSTACK;
  sigfillset(&action.sa_mask);
  return action;
}

void handle(int signal, const struct sigaction& action, bool unless_ignored) {
  struct sigaction& was = action_before[static_cast<std::size_t>(signal)];
  sigaction(signal, nullptr, &was);
  const bool is_ignored = (was.sa_flags & SA_SIGINFO) == 0 && was.sa_handler == SIG_IGN;
  if (!unless_ignored || !is_ignored) sigaction(signal, &action, nullptr);
}

/// A stack for handlers, so that one whose own has run out can still end in order.
void make_stack() {
  static std::array<char, 65536> memory;
  stack_t stack{};
  stack.ss_sp = memory.data();
  stack.ss_size = memory.size();
  sigaltstack(&stack, nullptr);
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

void say_when_interrupted(const std::string& text) {
  const int other = 1 - last_words.current.load();
  auto& place = last_words.texts[other];
  place[text.copy(place.data(), place.size() - 1)] = '\0';
  last_words.current.store(other);
}

void handle_signals() {
  static bool are_handled = false;
  if (std::exchange(are_handled, true)) return;
  make_stack();
  const struct sigaction exit = action_of(remove_and_exit), end = action_of(remove_and_end);
  // A program that was started with nohup keeps ignoring SIGHUP.
  for (const int signal : interruptions) handle(signal, exit, signal == SIGHUP);
  for (const int signal : endings) handle(signal, end, true);
  for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) handle(signal, end, true);
  for (const int signal : crashes) handle(signal, end, false);
  struct sigaction bus = end;
  bus.sa_sigaction = report_or_end;
  bus.sa_flags |= SA_SIGINFO;
  sigaction(SIGBUS, &bus, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace fathom::app
