#include "fathom/threads/startable_threads.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace fathom {
namespace {

std::ptrdiff_t threads_now() {
  const std::filesystem::directory_iterator tasks("/proc/self/task");
  return std::distance(begin(tasks), end(tasks));
}

TEST(StartableThreads, AreAsManyAsAskedForWhereNothingForbids) {
  EXPECT_EQ(startable_threads(-1), 0);
  EXPECT_EQ(startable_threads(0), 0);
  EXPECT_EQ(startable_threads(1), 1);
  EXPECT_EQ(startable_threads(20), 20);
}

TEST(StartableThreads, AreGoneAfterwards) {
  const auto before = threads_now();
  for (int i = 0; i < 20; ++i) {
    startable_threads(8);
    EXPECT_EQ(threads_now(), before);
  }
}

}  // namespace
}  // namespace fathom
