// Parallel work by oneTBB (FATHOM_THREADS=tbb).
#include <sys/types.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/scalable_allocator.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom {
namespace {

/// Loads TBB's allocator with the program. Otherwise oneTBB would load it when it starts, and
/// dlopen() of glibc 2.36 crashes if memory runs out while a loaded library loads others.
[[gnu::used]] const auto allocator_of_tbb = &scalable_msize;

/// A place for so many threads, or for all (0), or, where the process has fewer, for these: TBB
/// would ignore a request for more, and say so on standard error.
int size_of_arena(int threads) {
  const auto most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  if (threads == 0) return static_cast<int>(most);
  return static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(threads), most));
}

/// How many threads the system gives a process, as far as that has been found out.
class PossibleThreads {
 public:
  /// How many of so many threads there can be, the calling one among them. oneTBB does not survive
  /// that the system refuses it one (a limit on processes, or no memory for its stack), so this is
  /// found out before any are started. Once fewer can be had, it stays at these.
  int of(int wanted) {
    const std::lock_guard lock(mutex_);
    if (wanted > known_ && !short_of_threads_) {
      known_ = std::max(known_, 1 + startable_threads(wanted - 1));
      short_of_threads_ = known_ < wanted;
    }
    return std::min(wanted, known_);
  }

 private:
  std::mutex mutex_;
  int known_ = 1;
  bool short_of_threads_ = false;
};

/// Idle arenas, by the number of their threads. oneTBB 2021.8 loses 7 KB with each arena that ends,
/// so arenas are kept for the next call. Each call has one to itself: calls that shared one would
/// wait for each other.
class IdleArenas {
 public:
  std::unique_ptr<tbb::task_arena> take(int threads) {
    {
      const std::lock_guard lock(mutex_);
      std::vector<std::unique_ptr<tbb::task_arena>>& idle = idle_[threads];
      if (!idle.empty()) {
        std::unique_ptr<tbb::task_arena> arena = std::move(idle.back());
        idle.pop_back();
        return arena;
      }
      // There is room for all arenas of this size when they come back, which then cannot fail.
      idle.reserve(++made_[threads]);
    }
    return std::make_unique<tbb::task_arena>(threads);
  }

  void put_back(int threads, std::unique_ptr<tbb::task_arena> arena) noexcept {
    const std::lock_guard lock(mutex_);
    idle_.find(threads)->second.push_back(std::move(arena));
  }

 private:
  std::mutex mutex_;
  std::map<int, std::vector<std::unique_ptr<tbb::task_arena>>> idle_;
  /// How many arenas of each size there are, in use or idle.
  std::map<int, std::size_t> made_;
};

/// What calls of one process share.
struct ProcessThreads {
  pid_t process = ::getpid();
  /// Whether the process was forked off from one that had used TBB. TBB's threads do not exist in
  /// it, and a thread of the parent may have held one of TBB's locks: the calling thread does all
  /// work itself, without TBB.
  bool is_forked = false;
  PossibleThreads possible;
  IdleArenas arenas;
};

/// Never freed: at exit TBB may end before it. A forked process starts with a new object, because a
/// thread that exists only in its parent may hold a lock or a place in an arena.
ProcessThreads& process_threads() {
  static std::atomic<ProcessThreads*> current{nullptr};
  ProcessThreads* found = current.load();
  while (found == nullptr || found->process != ::getpid()) {
    auto fresh = std::make_unique<ProcessThreads>();
    fresh->is_forked = found != nullptr;
    if (current.compare_exchange_strong(found, fresh.get())) return *fresh.release();
  }
  return *found;
}

/// Runs `work` in an arena of this many threads, or of as many as the system starts.
template <class Work>
void run_in_arena(int threads, const Work& work) {
  ProcessThreads& shared = process_threads();
  const int size = shared.possible.of(threads);
  std::unique_ptr<tbb::task_arena> arena = shared.arenas.take(size);
  struct PutBack {
    ~PutBack() { arenas.put_back(size, std::move(arena)); }
    IdleArenas& arenas;
    int size;
    std::unique_ptr<tbb::task_arena>& arena;
  } const put_back{shared.arenas, size, arena};
  arena->execute(work);
}

/// Does some pieces of the work in the calling thread.
void do_pieces(std::size_t begin, std::size_t end, const std::function<void(std::size_t)>& work,
               InterruptionRequest request) {
  const StandardArithmetic standard;
  const Interruptible here(request);
  for (std::size_t i = begin; i != end; ++i) {
    check_interruption();
    work(i);
  }
}

void spread(std::size_t count, const std::function<void(std::size_t)>& work) {
  const InterruptionRequest request = current_interruption();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count),
                    [&](const auto& some) { do_pieces(some.begin(), some.end(), work, request); });
}

}  // namespace

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  if (process_threads().is_forked) return do_pieces(0, count, work, current_interruption());
  const int wanted = tbb::this_task_arena::max_concurrency();
  if (process_threads().possible.of(wanted) == wanted) return spread(count, work);
  run_in_arena(wanted, [&] { spread(count, work); });
}

void run_with_threads(int threads, const std::function<void()>& work) {
  require_thread_count(threads);
  const auto work_here = [&, request = current_interruption()] {
    const StandardArithmetic standard;
    const Interruptible here(request);
    work();
  };
  if (process_threads().is_forked) return work_here();
  run_in_arena(size_of_arena(threads), work_here);
}

}  // namespace fathom
