#include "validation/child/run_command.h"

#include <gtest/gtest.h>

#include "fathom/numeric/errors.h"

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
  EXPECT_EQ(run_command({"cat"}).text, "");
}

}  // namespace
}  // namespace fathom::validation
