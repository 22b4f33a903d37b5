// Work that ends early because another thread asks for it.
#include "fathom/threads/interruption.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "fathom/threads/threads.h"

namespace fathom {
namespace {

TEST(Interruption, WithoutARequestNothingHappens) {
  EXPECT_EQ(current_interruption(), nullptr);
  EXPECT_NO_THROW(check_interruption());
  const std::atomic<bool> request{false};
  const Interruptible here(&request);
  EXPECT_NO_THROW(check_interruption());
}

TEST(Interruption, ScopesAreNested) {
  const std::atomic<bool> made{true}, not_made{false};
  {
    const Interruptible outer(&made);
    {
      const Interruptible inner(&not_made);
      EXPECT_NO_THROW(check_interruption());
    }
    EXPECT_THROW(check_interruption(), Interrupted);
    EXPECT_EQ(current_interruption(), &made);
  }
  EXPECT_NO_THROW(check_interruption());
}

/// In all threads, and in parallel work within parallel work.
TEST(Interruption, EndsParallelWorkThatWouldNotEnd) {
  std::atomic<bool> request{false};
  std::atomic<int> pieces{0};
  const std::jthread other([&] {
    while (pieces < 10) std::this_thread::yield();
    request = true;
  });
  const Interruptible here(&request);
  const auto forever = [&] {
    with_threads(2, [&] {
      in_parallel(2, [&](std::size_t) {
        with_threads(2, [&] {
          in_parallel(1U << 30, [&](std::size_t) {
            ++pieces;
            std::this_thread::yield();
          });
        });
      });
    });
  };
  EXPECT_THROW(forever(), Interrupted);
}

/// A piece of work that asks for itself.
TEST(Interruption, EndsOnePieceThatWouldNotEnd) {
  std::atomic<bool> request{false};
  std::atomic<int> pieces{0};
  const std::jthread other([&] {
    while (pieces < 2) std::this_thread::yield();
    request = true;
  });
  const Interruptible here(&request);
  const auto forever = [&] {
    with_threads(2, [&] {
      in_parallel(2, [&](std::size_t) {
        ++pieces;
        while (true) {
          pieces = 2;  // where the machine has one thread, too
          check_interruption();
        }
      });
    });
  };
  EXPECT_THROW(forever(), Interrupted);
}

TEST(Interruption, IsFoundWithin256OccasionalChecks) {
  const std::atomic<bool> request{true};
  const Interruptible here(&request);
  OccasionalInterruption check;
  for (int i = 0; i < 255; ++i) check();
  EXPECT_THROW(check(), Interrupted);
}

TEST(Interruption, OfOneCallIsNoneOfOthers) {
  const std::atomic<bool> request{true};
  std::thread([&] {
    const Interruptible here(&request);
    EXPECT_THROW(in_parallel(8, [](std::size_t) {}), Interrupted);
  }).join();
  std::atomic<int> done = 0;
  with_threads(2, [&] { in_parallel(100, [&](std::size_t) { ++done; }); });
  EXPECT_EQ(done, 100);
}

}  // namespace
}  // namespace fathom
