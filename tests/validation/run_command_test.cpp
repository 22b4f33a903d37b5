#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"
#include "validation/child/child_process.h"

/// Other programs, started without a shell.
namespace fathom::validation {
namespace {

TEST(RunCommand, HearsBothOutputsAndTheStatus) {
  const Said said = run_command({"sh", "-c", "echo one; echo two >&2; exit 3"});
  EXPECT_EQ(said.text, "one\ntwo\n");
  EXPECT_EQ(said.status, 3);
}

TEST(RunCommand, TellsASignalAndAProgramThatIsNotThere) {
  EXPECT_EQ(run_command({"sh", "-c", "kill -TERM $$"}).status, 128 + 15);
  EXPECT_EQ(run_command({"fathom-no-such-program"}).status, 127);
}

/// What a path may hold is no command: the TMPDIR of a renderer's files, for one.
TEST(RunCommand, TakesArgumentsAsTheyAre) {
  for (const std::string& argument :
       {std::string("/tmp/x'; echo hacked; '"), std::string("$(echo hacked)"), std::string("`id`"),
        std::string("a b\n;c\"\\"), std::string("\xff*")}) {
    const Said said = run_command({"printf", "%s", argument});
    EXPECT_EQ(said.text, argument);
    EXPECT_EQ(said.status, 0);
  }
}

TEST(RunCommand, GivesNothingToRead) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  ASSERT_EQ(::write(ends[1], "typed", 5), 5);
  const int before = ::dup(STDIN_FILENO);
  ::dup2(ends[0], STDIN_FILENO);
  for (const int end : ends) ::close(end);
  EXPECT_EQ(run_command({"cat"}).text, "");
  ::dup2(before, STDIN_FILENO);
  ::close(before);
}

TEST(RunCommand, HearsMoreThanAPipeHolds) {
  EXPECT_EQ(run_command({"head", "-c", "300000", "/dev/zero"}).text, std::string(300'000, '\0'));
}

TEST(RunCommand, NamesWhatIsThereAndCannotBeStarted) {
  EXPECT_EQ(message_of<InputError>([] { run_command({"/dev/null"}); }),
            "/dev/null: cannot be started: Permission denied");
}

// Whoever has another end of it keeps it open.
TEST(RunCommand, GivesThePipeAsBothOutputsAndNothingElse) {
  const std::string open = run_command({"ls", "-l", "/proc/self/fd"}).text;
  const std::size_t begin = open.find(" 1 -> ") + 6;
  const std::string pipe = open.substr(begin, open.find('\n', begin) - begin);
  EXPECT_TRUE(pipe.starts_with("pipe:[")) << open;
  std::size_t count = 0;
  for (std::size_t at = open.find(pipe); at != open.npos; at = open.find(pipe, at + 1)) ++count;
  EXPECT_EQ(count, 2U) << open;
}

}  // namespace
}  // namespace fathom::validation
