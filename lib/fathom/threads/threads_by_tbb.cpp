// Parallel work by oneTBB (FATHOM_THREADS=tbb).
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/scalable_allocator.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>

#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/startable_threads.h"
#include "fathom/threads/threads.h"

namespace fathom {
namespace {

/// oneTBB would load its allocator when it starts. dlopen() of glibc 2.36 crashes where memory runs
/// out while a library that it loads loads others; one that the program names is there before.
[[gnu::used]] const auto allocator_of_tbb = &scalable_msize;

/// A place for so many threads, or for all (0), or, where the process has fewer, for these: TBB
/// would ignore a request for more, and say so on standard error.
int size_of_arena(int threads) {
  const auto most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  if (threads == 0) return static_cast<int>(most);
  return static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(threads), most));
}

/// How many of so many threads there can be, the calling one among them. oneTBB does not survive
/// that the system refuses it one (a limit on processes, or no memory for its stack), so this is
/// found out before any are started. Once fewer can be had, it stays at these.
int possible_threads(int wanted) {
  static std::mutex asking;
  static int known = 1;
  static bool short_of_threads = false;
  const std::lock_guard lock(asking);
  if (wanted > known && !short_of_threads) {
    known = std::max(known, 1 + startable_threads(wanted - 1));
    short_of_threads = known < wanted;
  }
  return std::min(wanted, known);
}

void spread(std::size_t count, const std::function<void(std::size_t)>& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& some) {
    const StandardArithmetic standard;
    for (std::size_t i = some.begin(); i != some.end(); ++i) work(i);
  });
}

}  // namespace

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  const int wanted = tbb::this_task_arena::max_concurrency();
  const int possible = possible_threads(wanted);
  if (possible == wanted) return spread(count, work);
  tbb::task_arena arena(possible);
  arena.execute([&] { spread(count, work); });
}

void run_with_threads(int threads, const std::function<void()>& work) {
  require_thread_count(threads);
  tbb::task_arena arena(possible_threads(size_of_arena(threads)));
  arena.execute([&] {
    const StandardArithmetic standard;
    work();
  });
}

}  // namespace fathom
