// Parallel work by the standard library (FATHOM_THREADS=std): each call of in_parallel() starts its
// threads. Slower than oneTBB for many short calls, but thread sanitizers see everything.
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom {
namespace {

/// How many threads the parallel work of this thread may use; 0: as many as the machine has.
thread_local int threads_here = 0;

class ThreadsHere {
 public:
  explicit ThreadsHere(int threads) : before_(std::exchange(threads_here, threads)) {}
  ThreadsHere(const ThreadsHere&) = delete;
  ThreadsHere& operator=(const ThreadsHere&) = delete;
  ~ThreadsHere() { threads_here = before_; }

 private:
  int before_;
};

/// Pieces of work that several threads take, each the next one.
class Pieces {
 public:
  Pieces(std::size_t count, const std::function<void(std::size_t)>& work)
      : count_(count), work_(work) {}

  /// Works until no piece is left or one has failed. Nested parallel work runs in the thread of its
  /// piece, because the other threads are busy here.
  void take() {
    const ThreadsHere one(1);
    for (std::size_t i = next(); i < count_; i = next()) {
      try {
        const StandardArithmetic standard;
        const Interruptible here(request_);
        check_interruption();
        work_(i);
      } catch (...) {
        fail(std::current_exception());
      }
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// Orders nothing but itself: or else no two pieces would seem to run at the same time to a
  /// sanitizer, unless they do.
  std::size_t next() { return next_.fetch_add(1, std::memory_order_relaxed); }

  void fail(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::move(failure);
    next_.store(count_, std::memory_order_relaxed);
  }

  std::size_t count_;
  const std::function<void(std::size_t)>& work_;
  /// The request of the thread that started the work.
  InterruptionRequest request_ = current_interruption();
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::exception_ptr failure_;
};

}  // namespace

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  const auto machine = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t most = threads_here > 0 ? static_cast<std::size_t>(threads_here) : machine;
  Pieces pieces(count, work);
  std::vector<std::thread> others;
  others.reserve(most);
  try {
    while (others.size() + 1 < std::min(most, count)) {
      others.emplace_back([&pieces] { pieces.take(); });
    }
  } catch (const std::system_error&) {
    // The system starts no more threads: the started threads do the work.
  }
  pieces.take();
  for (std::thread& thread : others) thread.join();
  pieces.rethrow();
}

void run_with_threads(int threads, const std::function<void()>& work) {
  require_thread_count(threads);
  const ThreadsHere here(threads);
  const StandardArithmetic standard;
  work();
}

}  // namespace fathom
