// Of processes that end together, one says why.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <functional>

#include "apps/shell/last_resort.h"
#include "tests/apps/test_folder.h"

namespace fathom::app {
namespace {

/// What a process of its own says to a question: what is set in it lasts as long as the process.
bool answer_of_process(const std::function<bool()>& ask) {
  const pid_t process = ::fork();
  if (process == 0) ::_exit(ask() ? 1 : 0);
  int status = 0;
  EXPECT_EQ(::waitpid(process, &status, 0), process);
  EXPECT_TRUE(WIFEXITED(status));
  return WEXITSTATUS(status) == 1;
}

TEST(LastWord, IsSaidOnceByAProcess) {
  EXPECT_TRUE(answer_of_process([] { return may_speak(); }));
  EXPECT_TRUE(answer_of_process([] { return may_speak() && !may_speak(); }));
}

TEST(LastWord, IsOfWhatTheProcessSpeaksOf) {
  EXPECT_TRUE(answer_of_process([] {
    speak(Speaks::of_interruptions);
    return !may_speak() && may_speak(Speaks::of_interruptions);
  }));
  EXPECT_FALSE(answer_of_process([] {
    speak(Speaks::of_nothing);
    return may_speak(Speaks::of_interruptions);
  }));
  EXPECT_TRUE(answer_of_process([] {
    speak(Speaks::of_nothing);
    speak(Speaks::of_all);
    return may_speak(Speaks::of_interruptions);
  }));
}

TEST(LastWord, IsSaidByTheFirstOfThoseThatShareAFile) {
  const test::TestFolder folder;
  const auto ask = [&] {
    share_last_word(folder / "said");
    return may_speak();
  };
  EXPECT_TRUE(answer_of_process(ask));
  EXPECT_FALSE(answer_of_process(ask));
}

// The file cannot be made: then the number tells.
TEST(LastWord, IsSaidByTheFirstOfThoseThatShareANumber) {
  const auto ask = [](int said) {
    return answer_of_process([said] {
      std::atomic<int> number{said};
      share_last_word("/nowhere/at/all/said");
      share_last_word(&number);
      return may_speak() && number == 1;
    });
  };
  EXPECT_TRUE(ask(0));
  EXPECT_FALSE(ask(1));
}

}  // namespace
}  // namespace fathom::app
