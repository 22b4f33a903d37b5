#include "apps/shell/signals.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "apps/shell/failures.h"
#include "apps/shell/last_resort.h"
#include "apps/shell/part_files.h"
#include "fathom/files/mapped_file.h"

// Handlers call only what is safe in them.
namespace fathom::app {
namespace {

constexpr std::array interruptions{SIGINT, SIGTERM, SIGHUP};
constexpr std::array endings{SIGQUIT, SIGALRM,   SIGVTALRM, SIGPROF, SIGUSR1,
                             SIGUSR2, SIGSTKFLT, SIGIO,     SIGPWR,  SIGXCPU};
constexpr std::array crashes{SIGSEGV, SIGABRT, SIGFPE, SIGILL, SIGBUS, SIGSYS, SIGTRAP};

/// What a crash did before: what dies of a sanitizer's check is reported by that.
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

void say_at_once(const char* text) {
  if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

extern "C" FATHOM_NOT_ADDRESS_SANITIZED void remove_and_exit(int) {
  remove_all_pending();
  const char* const text = last_words.texts[last_words.current.load()].data();
  if (*text != '\0' && may_report(Ending::interruption)) say_at_once(text);
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
    say_at_once("fathom: error: ");
    say_at_once(file);
    say_at_once(": has been cut short while it was read\n");
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
