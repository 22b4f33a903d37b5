#include "fathom/threads/threads.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <latch>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/threads/per_thread.h"

namespace fathom {
namespace {

TEST(InParallel, DoesEachPieceOfWorkOnce) {
  for (const int threads : {0, 1, 2, 7}) {
    std::vector<std::atomic<int>> done(1000);
    with_threads(threads, [&] { in_parallel(done.size(), [&](std::size_t i) { ++done[i]; }); });
    for (const auto& count : done) EXPECT_EQ(count, 1);
  }
}

TEST(InParallel, CountsFromTheFirstIndexOn) {
  std::atomic<std::uint64_t> sum{0};
  parallel_for(std::uint32_t{0xFFFFFFF0}, std::uint32_t{0xFFFFFFFF},
               [&](std::uint32_t i) { sum += i; });
  std::uint64_t expected = 0;
  for (std::uint64_t i = 0xFFFFFFF0; i < 0xFFFFFFFF; ++i) expected += i;
  EXPECT_EQ(sum, expected);
  parallel_for(3, 3, [](int) { FAIL() << "there is nothing to do"; });
}

TEST(InParallel, PassesAnExceptionOn) {
  const auto fail = [](std::size_t i) {
    if (i == 77) throw std::runtime_error("77");
  };
  try {
    in_parallel(100, fail);
    FAIL() << "no exception came out";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "77");
  }
}

TEST(WithThreads, UsesAsManyAsAskedForAndGivesTheResult) {
  EXPECT_EQ(with_threads(1, [] { return std::string("result"); }), "result");
  std::mutex mutex;
  std::set<std::thread::id> seen;
  with_threads(1, [&] {
    in_parallel(200, [&](std::size_t) {
      const std::lock_guard lock(mutex);
      seen.insert(std::this_thread::get_id());
    });
  });
  EXPECT_EQ(seen.size(), 1U);
}

/// A library does not change what belongs to the process.
TEST(WithThreads, LeavesTheProcessAsItIs) {
  const auto most = [] {
    return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  };
  const std::size_t before = most();
  with_threads(3, [&] { EXPECT_EQ(most(), before); });
  EXPECT_EQ(most(), before);
}

/// TBB would say on standard error that it ignores such a request.
TEST(WithThreads, MoreThanTheProcessHasAreNotAskedFor) {
  const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
  ::testing::internal::CaptureStderr();
  std::atomic<int> done = 0;
  with_threads(most_threads, [&] { in_parallel(100, [&](std::size_t) { ++done; }); });
  EXPECT_EQ(done, 100);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(WithThreads, RefusesNumbersThatNobodyHas) {
  for (const int threads : {-1, std::numeric_limits<int>::min(), most_threads + 1}) {
    EXPECT_THROW(with_threads(threads, [] { FAIL(); }), UsageError);
  }
}

/// Threads of the program ask at the same time, and their work asks again.
TEST(WithThreads, MayBeCalledBySeveralThreadsAndWithinItself) {
  std::atomic<int> done = 0;
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 4; ++caller) {
    callers.emplace_back([&done, caller] {
      with_threads(caller, [&] {
        in_parallel(20, [&](std::size_t i) {
          with_threads(static_cast<int>(i % 3),
                       [&] { in_parallel(20, [&](std::size_t) { ++done; }); });
          in_parallel(5, [&](std::size_t) { ++done; });
        });
      });
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(done, 4 * 20 * 25);
}

TEST(WithThreads, AFailureWithinComesOutOfAllOfIt) {
  const auto nested = [] {
    in_parallel(8, [](std::size_t) {
      with_threads(2, [] {
        in_parallel(8, [](std::size_t i) {
          if (i == 5) throw std::runtime_error("5");
        });
      });
    });
  };
  EXPECT_THROW(with_threads(4, nested), std::runtime_error);
}

/// Two calls that shared one place for one thread would wait for each other for ever.
TEST(WithThreads, CallsOfSeveralThreadsRunAtTheSameTime) {
  for (const int threads : {1, 2}) {
    std::latch all_are_in(3);
    std::vector<std::thread> callers;
    for (int caller = 0; caller < 3; ++caller)
      callers.emplace_back([&] { with_threads(threads, [&] { all_are_in.arrive_and_wait(); }); });
    for (std::thread& caller : callers) caller.join();
  }
}

std::size_t resident_bytes() {
  std::size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

#ifndef FATHOM_SANITIZED
TEST(WithThreads, MemoryDoesNotGrowWithCalls) {
  const auto call = [](int times) {
    for (int i = 0; i < times; ++i) with_threads(2, [] { in_parallel(20, [](std::size_t) {}); });
  };
  call(500);  // what is made once and kept
  const std::size_t before = resident_bytes();
  constexpr int calls = 4000;
  call(calls);
  // An arena that is lost takes 7300 bytes: 29 MB. A block that is lost in each call takes 16 at
  // least: 64 KB. Beside that, the threads of TBB may touch new pages of their stacks.
  EXPECT_LT(resident_bytes(), before + calls * 250);
}
#endif

/// A process that is forked off has none of the other threads, in which places may be taken and
/// locks held.
TEST(WithThreads, WorksInAProcessThatIsForkedOff) {
  const auto sum = [] {
    std::atomic<int> done = 0;
    with_threads(2, [&] { in_parallel(100, [&](std::size_t) { ++done; }); });
    return done.load();
  };
  ASSERT_EQ(sum(), 100);
  std::atomic<bool> stop = false;
  std::vector<std::thread> others;
  for (int i = 0; i < 2; ++i)
    others.emplace_back([&] {
      while (!stop) sum();
    });
  for (int i = 0; i < 20; ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::alarm(60);
      ::_exit(sum() == 100 ? 0 : 1);
    }
    int status = -1;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
  }
  stop = true;
  for (std::thread& other : others) other.join();
}

TEST(PerThread, EachThreadHasItsOwnAndAllAreThereInTheEnd) {
  PerThread<std::pair<std::thread::id, int>> counts(
      [] { return std::pair(std::this_thread::get_id(), 0); });
  with_threads(7, [&] {
    in_parallel(1000, [&](std::size_t) {
      auto& [thread, count] = counts.local();
      EXPECT_EQ(thread, std::this_thread::get_id());
      ++count;
      // Or else the first thread has done it all before the second begins.
      std::this_thread::sleep_for(std::chrono::microseconds(10));
    });
  });
  int sum = 0;
  counts.for_each([&](const auto& value) { sum += value.second; });
  EXPECT_EQ(sum, 1000);
}

TEST(PerThread, AValueThatCannotBeMadeIsMadeAgain) {
  int tries = 0;
  PerThread<int> value([&] {
    if (++tries == 1) throw std::runtime_error("not yet");
    return tries;
  });
  EXPECT_THROW(value.local(), std::runtime_error);
  value.for_each([](int) { FAIL() << "there is none"; });
  EXPECT_EQ(value.local(), 2);
  EXPECT_EQ(value.local(), 2);
}

TEST(Progress, CountsPartsOneAtATimeAndToTheEnd) {
  std::vector<double> shares;
  const std::function<void(double)> report = [&](double share) { shares.push_back(share); };
  Progress progress(report, 50);
  in_parallel(50, [&](std::size_t) { progress.part_done(); });
  ASSERT_EQ(shares.size(), 50U);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    EXPECT_EQ(shares[i], static_cast<double>(i + 1) / 50);
  }
}

}  // namespace
}  // namespace fathom
