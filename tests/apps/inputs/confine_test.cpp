// --confine: what scene files and glTF may open; --threads beyond what the machine has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "tests/apps/run_program.h"
#include "tests/apps/sample_files.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {
namespace {

using ::testing::HasSubstr;

const std::string triangle = "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n";

class Confine : public ::testing::Test {
 protected:
  Confine() {
    std::filesystem::create_directory(folder / "inside");
    folder.write("outside.obj", triangle);
    folder.write("inside/own.obj", triangle);
    folder.write("inside/reaching.json", R"({"meshes": [{"file": "../outside.obj"}]})");
    folder.write("inside/keeping.json", R"({"meshes": [{"file": "own.obj"}]})");
  }
  Outcome run(std::vector<std::string> arguments) {
    return run_fathom(arguments, {.folder = folder.path()});
  }
  TestFolder folder;
};

TEST_F(Confine, EveryCommandThatReadsAScene) {
  const std::vector<std::vector<std::string>> commands{
      {"render", "inside/reaching.json", "-o", "out.exr"},
      {"probe", "inside/reaching.json", "--pixel", "1,1"},
      {"info", "inside/reaching.json"},
      {"visible", "inside/reaching.json"},
      {"coplanar", "inside/reaching.json"},
      {"camera", "orbit", "inside/reaching.json", "--views", "2", "-o", "path.json"},
      {"pipeline", "trace", "inside/reaching.json", "--triangle", "0"}};
  for (std::vector<std::string> command : commands) {
    EXPECT_EQ(run(command).status, 0) << command[0] << ": " << run(command).err;
    for (const char* output : {"out.exr", "out.png", "path.json"})
      std::filesystem::remove(folder / output);
    const std::vector<std::string> before = folder.names();
    command.insert(command.end(), {"--confine", "inside"});
    const Outcome refused = run(command);
    EXPECT_EQ(refused.status, 3) << command[0];
    EXPECT_EQ(refused.err,
              "fathom: error: inside/../outside.obj: lies outside inside, to which files named by "
              "other files are confined\n")
        << command[0];
    EXPECT_EQ(folder.names(), before) << command[0];
  }
}

TEST_F(Confine, LetsThroughWhatLiesInside) {
  EXPECT_EQ(run({"info", "inside/keeping.json", "--confine", "inside"}).status, 0);
  EXPECT_EQ(run({"info", "inside/keeping.json", "--confine", "./inside/."}).status, 0);
  EXPECT_EQ(run({"info", "inside/reaching.json", "--confine", "."}).status, 0);
  EXPECT_EQ(run({"info", "outside.obj", "--confine", "inside"}).status, 0);  // the user's own words
}

TEST_F(Confine, NeedsAFolder) {
  for (const char* folder_name : {"none", "outside.obj"}) {
    const Outcome refused = run({"info", "inside/keeping.json", "--confine", folder_name});
    EXPECT_EQ(refused.status, 2) << folder_name;
    EXPECT_THAT(refused.err, HasSubstr("is no folder")) << folder_name;
  }
}

/// Opened, a pipe that nobody writes to would be waited for without end.
TEST_F(Confine, PipesInSceneFilesAreRefusedAndThoseOfTheUserAreRead) {
  ASSERT_EQ(mkfifo((folder / "inside/pipe.obj").c_str(), 0600), 0);
  folder.write("inside/piping.json", R"({"meshes": [{"file": "pipe.obj"}]})");
  const Outcome refused = run({"render", "inside/piping.json", "-o", "out.exr"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_THAT(refused.err, HasSubstr("inside/pipe.obj: is not a regular file"));
  const Outcome read = run_fathom({"info", "/dev/stdin", "--mesh-format", "obj"},
                                  {.folder = folder.path(), .input = triangle});
  EXPECT_EQ(read.status, 0) << read.err;
}

/// A map names its sources as its user did, whatever the folder in which that was.
TEST_F(Confine, MapsNameTheirSourcesAsTheyWereGiven) {
  ASSERT_EQ(run({"render", "inside/reaching.json", "-o", "out.exr"}).status, 0);
  const Outcome info = run({"info", "out.exr", "--json"});
  EXPECT_THAT(info.out, HasSubstr("inside/../outside.obj"));
  EXPECT_THAT(info.out, ::testing::Not(HasSubstr(folder.path().string())));
}

/// Nobody is told of limits that concern nobody.
TEST_F(Confine, MoreThreadsThanTheMachineHasAreTakenInSilence) {
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"render", "outside.obj", "-o", "out.exr"},
                                             {"render", "outside.obj", "-o", "out.exr", "--deep"},
                                             {"visible", "outside.obj"},
                                             {"coplanar", "outside.obj"}}) {
    std::vector<std::string> with_threads = command;
    with_threads.insert(with_threads.end(), {"--threads", "77"});
    const Outcome outcome = run(with_threads);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "") << command[0];
  }
}

}  // namespace
}  // namespace fathom::test
