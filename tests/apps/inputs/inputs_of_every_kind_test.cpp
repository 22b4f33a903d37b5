// Inputs that are no ordinary files: pipes, standard input, process substitutions, devices.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/faults.h"
#include "tests/apps/run_program.h"
#include "tests/apps/sample_files.h"
#include "tests/apps/test_folder.h"
#include "tests/places.h"

namespace fathom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string meshes = source_dir() / "data/meshes/";

class Inputs : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_.write("square.obj", square_obj);
    folder_.write("camera.json", square_camera);
    folder_.write("scene.json", R"({"meshes": [{"file": "square.obj"}]})");
    ASSERT_EQ(bash("render square.obj --camera camera.json -o map.exr").status, 0);
    ASSERT_EQ(bash("convert map.exr -o map.npy").status, 0);
    ASSERT_EQ(bash("convert map.exr -o map.pfm").status, 0);
    ASSERT_EQ(bash("convert map.exr -o map.png").status, 0);
    ASSERT_EQ(bash("convert map.exr -o map.bin").status, 0);
  }

  /// A command line of fathom, as bash reads it; `before` comes before the program, as in "cat |".
  Outcome bash(const std::string& line, const std::string& before = "") const {
    RunOptions options{.folder = folder_.path()};
    options.memory = rlim_t{3} << 30;
    return run({"/bin/bash", "-c", before + "\"$0\" " + line, program_path()}, options);
  }

  TestFolder folder_;
};

/// What `info` says, without the name of the file.
std::string answer(const Outcome& outcome) {
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::size_t colon = outcome.out.find(": ");
  std::string text = outcome.out.substr(std::min(colon, outcome.out.size()));
  // Nor does the source have it.
  return text.substr(0, text.find("  source")).substr(0, text.find("  object"));
}

TEST_F(Inputs, InfoTellsTheKindOfWhatComesThroughAPipe) {
  const std::vector<std::string> files{"square.obj",
                                       "camera.json",
                                       "scene.json",
                                       "map.exr",
                                       "map.npy",
                                       "map.pfm",
                                       "map.png",
                                       "map.bin",
                                       meshes + "cube.stl",
                                       meshes + "cube-ascii.stl",
                                       meshes + "cube-big-endian.ply",
                                       meshes + "house.glb"};
  for (const std::string& file : files) {
    const std::string truth = answer(bash("info " + file));
    EXPECT_THAT(truth, StartsWith(": a ")) << file;
    EXPECT_EQ(answer(bash("info <(cat " + file + ")")), truth) << file;
    EXPECT_EQ(answer(bash("info -", "cat " + file + " | ")), truth) << file;
    EXPECT_EQ(answer(bash("info /dev/stdin", "cat " + file + " | ")), truth) << file;
    EXPECT_EQ(answer(bash("info - < " + file)), truth) << file;
  }
}

TEST_F(Inputs, EveryInputOfARenderMayBeAPipe) {
  for (const char* const line :
       {"render <(cat square.obj) --camera <(cat camera.json) -o piped.pfm",
        "render <(cat scene.json) --camera <(cat camera.json) -o piped.pfm",
        "render - --camera camera.json -o piped.pfm < square.obj",
        "render - --camera camera.json -o piped.pfm < scene.json",
        "render square.obj --camera - -o piped.pfm < camera.json",
        "convert <(cat map.exr) -o piped.pfm", "convert - -o piped.pfm < map.exr"}) {
    const Outcome outcome = bash(line);
    EXPECT_EQ(outcome.status, 0) << line << outcome.err;
    EXPECT_TRUE(folder_.read("piped.pfm") == folder_.read("map.pfm")) << line;
  }
  EXPECT_EQ(bash("compare <(cat map.exr) - < map.exr").status, 0);
  EXPECT_EQ(bash("render square.obj --camera camera.json -o /dev/stdout > redirected.exr").status,
            0);
  EXPECT_EQ(bash("compare map.exr redirected.exr").status, 0);
  EXPECT_EQ(bash("visible <(cat square.obj)").status, 0);
  EXPECT_EQ(bash("probe <(cat square.obj) --pixel 1,1").status, 0);
  EXPECT_EQ(bash("preview <(cat map.exr) -o map.png").status, 0);
}

/// What is read in parts, or twice, says that it has to be a file.
TEST_F(Inputs, StreamedOnesAreFiles) {
  const Outcome outcome = bash("render <(cat " + meshes + "cube.stl) --stream -o map.exr");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_THAT(outcome.err, HasSubstr("is not a regular file"));
}

TEST_F(Inputs, DevicesAreRefusedUnread) {
  for (const char* const line :
       {"info /dev/zero", "render /dev/zero -o no.exr",
        "render square.obj --camera /dev/zero -o no.exr", "compare map.exr /dev/urandom",
        "info /dev/full", "preview /dev/zero -o no.png"}) {
    const Outcome outcome = bash(line);
    EXPECT_EQ(outcome.status, 3) << line;
    EXPECT_EQ(lines_of(outcome.err), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(": is a device, expected a file or a pipe")) << line;
  }
  EXPECT_THAT(bash("info /dev/null").err, HasSubstr("/dev/null: is empty"));
  EXPECT_FALSE(fs::exists(folder_ / "no.exr"));
}

/// They take bounded memory: RunOptions::memory.
TEST_F(Inputs, PipesWithoutAnEndAreGivenUp) {
  for (const char* const line :
       {"info - < /dev/zero", "info <(cat /dev/zero)",
        "render square.obj --camera <(yes) -o no.exr", "compare map.exr <(yes)"}) {
    const Outcome outcome = bash(line);
    EXPECT_EQ(outcome.status, 3) << line;
    EXPECT_EQ(lines_of(outcome.err), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("has no end after 1073741824 bytes")) << line;
  }
  const Outcome line = bash("depth encode --storage unorm16 --near 1 --far 2 < /dev/zero");
  EXPECT_EQ(line.status, 3);
  EXPECT_THAT(line.err, HasSubstr("standard input: line 1: "));
}

}  // namespace
}  // namespace fathom::test
