// One of several processes that end together reports the reason.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <functional>

#include "apps/mpi/together.h"
#include "tests/apps/test_folder.h"

namespace fathom::app {
namespace {

/// Answer of a separate process, so that its settings end with it.
bool answer_of_process(const std::function<bool()>& ask) {
  const pid_t process = ::fork();
  if (process == 0) ::_exit(ask() ? 1 : 0);
  int status = 0;
  EXPECT_EQ(::waitpid(process, &status, 0), process);
  EXPECT_TRUE(WIFEXITED(status));
  return WEXITSTATUS(status) == 1;
}

TEST(LastWord, IsSaidOnceByAProcess) {
  EXPECT_TRUE(answer_of_process([] { return may_report(); }));
  EXPECT_TRUE(answer_of_process([] { return may_report() && !may_report(); }));
}

TEST(LastWord, IsOfWhatTheProcessSpeaksOf) {
  EXPECT_TRUE(answer_of_process([] {
    report_only(Reports::interruptions);
    return !may_report() && may_report(Ending::interruption);
  }));
  EXPECT_FALSE(answer_of_process([] {
    report_only(Reports::nothing);
    return may_report(Ending::interruption);
  }));
  EXPECT_TRUE(answer_of_process([] {
    report_only(Reports::nothing);
    report_only(Reports::everything);
    return may_report(Ending::interruption);
  }));
}

TEST(LastWord, IsSaidByTheFirstOfThoseThatShareAFile) {
  const test::TestFolder folder;
  const auto ask = [&] {
    share_last_word(folder / "said");
    return may_report();
  };
  EXPECT_TRUE(answer_of_process(ask));
  EXPECT_FALSE(answer_of_process(ask));
}

// The file cannot be made: then the number decides.
TEST(LastWord, IsSaidByTheFirstOfThoseThatShareANumber) {
  const auto ask = [](int said) {
    return answer_of_process([said] {
      std::atomic<int> number{said};
      share_last_word("/nowhere/at/all/said");
      share_last_word(&number);
      return may_report() && number == 1;
    });
  };
  EXPECT_TRUE(ask(0));
  EXPECT_FALSE(ask(1));
}

}  // namespace
}  // namespace fathom::app
