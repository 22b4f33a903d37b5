#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "fathom/threads/threads.h"

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

/// What `count` returns in a process of its own, after `limit`; below 256.
int counted_in_child(const std::function<void()>& limit, const std::function<int()>& count) {
  const pid_t child = ::fork();
  if (child == 0) {
    limit();
    ::_exit(count());
  }
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  return WEXITSTATUS(status);
}

// Each counts while the others live, and is not counted any more when the next are started.
TEST(StartableThreads, AreNoMoreThanTheLimitOfTheUser) {
  if (::geteuid() != 0) GTEST_SKIP() << "needs a user without other processes";
  const auto ten_processes = [] {
    constexpr uid_t nobody_else = 54321;
    if (::setgid(nobody_else) != 0 || ::setuid(nobody_else) != 0) ::_exit(255);
    const rlimit most{10, 10};
    ::setrlimit(RLIMIT_NPROC, &most);
  };
#ifdef __SANITIZE_THREAD__  // which has a thread of its own
  constexpr int others = 8;
#else
  constexpr int others = 9;
#endif
  const auto count_often = [] {
    for (int i = 0; i < 200; ++i) {
      if (const int count = startable_threads(100); count != others) return count;
    }
    return others;
  };
  EXPECT_EQ(counted_in_child(ten_processes, count_often), others);
}

#ifndef FATHOM_SANITIZED  // whose shadow memory takes all addresses
TEST(StartableThreads, AreNoMoreThanHaveRoomForTheirStacks) {
  const auto little_room = [] {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const auto now = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const rlimit most{now + (42U << 20U), now + (42U << 20U)};
    ::setrlimit(RLIMIT_AS, &most);
  };
  // Some take the stacks of threads that have ended.
  const int count = counted_in_child(little_room, [] { return startable_threads(100); });
  EXPECT_GE(count, 10);
  EXPECT_LT(count, 100);
}
#endif

}  // namespace
}  // namespace fathom
