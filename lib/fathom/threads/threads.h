#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

/// Parallel work, and reports of its progress. oneTBB does it, in one .cpp: its headers take
/// seconds to compile. All of it runs in StandardArithmetic.
namespace fathom {

/// Calls work(0), …, work(count − 1), several at the same time, in the threads of with_threads() or
/// in all that there are. An exception ends it and is passed on; so does a request
/// (interruption.h).
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& work);

/// in_parallel() for work(first), …, work(end − 1), with first ≤ end.
template <class Index, class Work>
void parallel_for(Index first, Index end, const Work& work) {
  in_parallel(static_cast<std::size_t>(end - first),
              [&](std::size_t i) { work(static_cast<Index>(first + static_cast<Index>(i))); });
}

/// The greatest number of threads that can be requested.
inline constexpr int most_threads = 1024;

/// Refuses numbers of threads outside that range.
/// Fails    UsageError "threads: expected …" unless 0 ≤ threads ≤ most_threads.
void require_thread_count(int threads);

/// Runs `work` with this many threads; 0: all. Several threads may call at the same time, and
/// `work` may call again; no setting of the process changes. Therefore the number is limited to
/// TBB's threads: as many as the machine has, unless the program changes that
/// (tbb::global_control).
/// Fails    UsageError as require_thread_count().
void run_with_threads(int threads, const std::function<void()>& work);

template <class Work>
auto with_threads(int threads, const Work& work) {
  if constexpr (std::is_void_v<decltype(work())>) {
    run_with_threads(threads, work);
  } else {
    std::optional<decltype(work())> result;
    run_with_threads(threads, [&] { result.emplace(work()); });
    return std::move(*result);
  }
}

/// Reports the fraction of equal parts that are done, from one thread at a time.
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

/// How many more threads the system lets this process start, up to `most`. Starts that many
/// threads, which do nothing and have ended when this returns.
int startable_threads(int most);

}  // namespace fathom
