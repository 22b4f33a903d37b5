#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

/// Threads, and how far they have come.
namespace fathom::triangle {

/// Reports the share of equal parts that are done, from one thread at a time.
class Progress {
 public:
  Progress(const std::function<void(double)>& report, std::uint64_t parts)
      : report_(report), parts_(parts) {}
  void part_done() {
    if (!report_) return;
    const std::lock_guard lock(mutex_);
    report_(static_cast<double>(++done_) / static_cast<double>(parts_));
  }

 private:
  const std::function<void(double)>& report_;
  std::uint64_t parts_;
  std::uint64_t done_ = 0;
  std::mutex mutex_;
};

/// Runs `work` with as many threads as asked for; 0: all. More threads than the machine has are
/// allowed: TBB's own limit is lifted meanwhile.
template <class Work>
auto with_threads(int threads, const Work& work) {
  std::optional<tbb::global_control> limit;
  if (threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  return arena.execute(work);
}

}  // namespace fathom::triangle
