// Commands that are programs of their own: fathom becomes them, lists them, and says how to build
// them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_program.h"
#include "test_folder.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::vector<std::string> companion_commands{
    "clip",  "scan", "pipeline", "study",    "bench",    "validate", "view", "formats", "visible",
    "areas", "sun",  "draw",     "evaluate", "coplanar", "cast",     "sees", "doctor"};

/// A folder with `fathom` alone, and what stands in for other programs beside it.
class Companions : public ::testing::Test {
 protected:
  Companions() { std::filesystem::copy_file(program_path(), folder_ / "fathom"); }

  /// A program that shows its arguments and ends with status 7.
  void put(const std::string& name) const {
    folder_.write(name, "#!/bin/sh\nprintf '<%s>' \"$0\" \"$@\"\nexit 7\n");
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
  }

  [[nodiscard]] Outcome fathom(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), folder_ / "fathom");
    return run(arguments, {.folder = folder_.path()});
  }

  /// The arguments that the program got; nothing but its name where it got none.
  void expect_start(const std::vector<std::string>& arguments, const std::string& program,
                    const std::string& shown) const {
    const Outcome outcome = fathom(arguments);
    EXPECT_EQ(outcome.status, 7) << outcome.err;
    EXPECT_EQ(outcome.out, "<" + (folder_ / program) + ">" + shown);
  }

  TestFolder folder_;
};

TEST_F(Companions, AnyProgramBesideIsStartedWithItsArguments) {
  put("fathom-greet");
  expect_start({"greet", "--one", "two words"}, "fathom-greet", "<--one><two words>");
}

TEST_F(Companions, OfOneCommandGetAllButItsName) {
  put("fathom-study");
  expect_start({"study"}, "fathom-study", "");
  expect_start({"--quiet", "study", "--list"}, "fathom-study", "<--quiet><--list>");
  expect_start({"study", "--help"}, "fathom-study", "<--help>");
}

TEST_F(Companions, OfSeveralCommandsGetTheNameToo) {
  put("fathom-textbook");
  for (const std::string command : {"clip", "scan", "pipeline"}) {
    expect_start({command, "--x", "y z"}, "fathom-textbook", "<" + command + "><--x><y z>");
  }
}

TEST_F(Companions, RenderWithThePipelineInEitherSpelling) {
  put("fathom-textbook");
  expect_start({"render", "a.obj", "-o", "b.exr", "--engine", "pipeline"}, "fathom-textbook",
               "<render><a.obj><-o><b.exr><--engine><pipeline>");
  expect_start({"render", "a.obj", "--engine=pipeline", "-o", "b.exr"}, "fathom-textbook",
               "<render><a.obj><--engine=pipeline><-o><b.exr>");
}

TEST_F(Companions, ThatAreNotBuiltAreToldHow) {
  for (const std::string& command : companion_commands) {
    const Outcome outcome = fathom({command, "--help"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_THAT(outcome.err, StartsWith("fathom: error: '" + command + "' is a separate program"));
    EXPECT_THAT(outcome.err, HasSubstr("'scripts/fathom " + command + "'"));
  }
  const Outcome outcome = fathom({"render", "a.obj", "-o", "b.exr", "--engine", "pipeline"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("'scripts/fathom render … --engine pipeline'"));
}

TEST_F(Companions, ThatCannotBeStartedAreAnError) {
  folder_.write("fathom-study", "no program");
  const Outcome outcome = fathom({"study"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, StartsWith("fathom: error: " + (folder_ / "fathom-study") + ": "));
}

TEST_F(Companions, AreListedWithTheCommands) {
  const Outcome help = fathom({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const std::string& command : companion_commands) {
    EXPECT_THAT(help.out, HasSubstr("\n  " + command + " "));
  }
}

TEST(BuiltCompanions, ShowTheirHelpAsFathomDoes) {
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"clip"}, {"scan"}, {"pipeline"}, {"pipeline", "trace"}, {"study"}}) {
    std::vector<std::string> arguments = command;
    arguments.emplace_back("--help");
    const Outcome help = run_fathom(arguments);
    std::string name = "fathom";
    for (const std::string& word : command) name += " " + word;
    EXPECT_EQ(help.status, 0) << name;
    EXPECT_THAT(help.out, HasSubstr("Examples:\n  ")) << name;
    EXPECT_THAT(help.out, HasSubstr("Usage: " + name + " [OPTIONS]")) << name;
    const Outcome wrong = run_fathom({command[0], "--frobnicate"});
    EXPECT_EQ(wrong.status, 2) << name;
    EXPECT_THAT(wrong.err, StartsWith("fathom: error: ")) << name;
  }
}

}  // namespace
}  // namespace fathom::test
