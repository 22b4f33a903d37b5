#include "fathom/threads/threads.h"

#include <pthread.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <deque>
#include <mutex>
#include <string>

#include "fathom/failures/errors.h"

namespace fathom {

void require_thread_count(int threads) {
  if (threads < 0 || threads > most_threads) {
    throw UsageError(Setting{"threads"}, "expected 0 to " + std::to_string(most_threads));
  }
}

namespace {

/// A thread that lives until `leave` is unlocked, and its number.
struct Waiting {
  std::mutex* leave = nullptr;
  std::atomic<pid_t> number{0};
  pthread_t thread{};
};

void* wait(void* argument) {
  auto& self = *static_cast<Waiting*>(argument);
  self.number.store(static_cast<pid_t>(::syscall(SYS_gettid)));
  const std::lock_guard lock(*self.leave);
  return nullptr;
}

/// A thread that has been joined is still counted for a moment, against the limit on processes.
void wait_until_gone(const Waiting& waiting) {
  constexpr int most_tries = 100000;
  for (int i = 0; i < most_tries; ++i) {
    if (::syscall(SYS_tgkill, ::getpid(), waiting.number.load(), 0) != 0) return;
    ::sched_yield();
  }
}

}  // namespace

int startable_threads(int most) {
  constexpr std::size_t stack = std::size_t{4} << 20;  // as oneTBB's
  pthread_attr_t attributes;
  if (most <= 0 || ::pthread_attr_init(&attributes) != 0) return 0;
  ::pthread_attr_setstacksize(&attributes, stack);
  std::mutex leave;
  std::deque<Waiting> started;
  {
    const std::lock_guard lock(leave);
    for (int i = 0; i < most; ++i) {
      Waiting& waiting = started.emplace_back();
      waiting.leave = &leave;
      if (::pthread_create(&waiting.thread, &attributes, wait, &waiting) == 0) continue;
      started.pop_back();
      break;
    }
  }
  for (Waiting& waiting : started) ::pthread_join(waiting.thread, nullptr);
  for (const Waiting& waiting : started) wait_until_gone(waiting);
  ::pthread_attr_destroy(&attributes);
  return static_cast<int>(started.size());
}

}  // namespace fathom
