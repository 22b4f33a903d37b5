// Parallel work by oneTBB (FATHOM_THREADS=tbb).
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/threads.h"

namespace fathom {
namespace {

/// A place for so many threads or, where the process has fewer, for these: TBB would ignore a
/// request for more, and say so on standard error.
int size_of_arena(int threads) {
  const auto most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(threads), most));
}

}  // namespace

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const StandardArithmetic standard;
    work(i);
  });
}

void run_with_threads(int threads, const std::function<void()>& work) {
  require_thread_count(threads);
  tbb::task_arena arena(threads > 0 ? size_of_arena(threads) : tbb::task_arena::automatic);
  arena.execute([&] {
    const StandardArithmetic standard;
    work();
  });
}

}  // namespace fathom
