#include "fathom/threads/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

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
