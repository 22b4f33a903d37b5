// The commands of the pages, run as their readers run them: they have to draw the pages' pictures.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/effort.h"
#include "tests/places.h"
#include "tests/validation/study/study_page.h"

namespace fathom::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string unescaped(std::string text) {
  const std::pair<std::string, std::string> characters[] = {
      {"<span>", ""}, {"</span>", ""}, {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}};
  for (const auto& [from, to] : characters) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  }
  return text;
}

/// A shell's command line, with this build's program on the PATH.
Outcome run_by_shell(const std::string& command, const fs::path& folder) {
  RunOptions options{.folder = folder};
  options.prepare = [] {
    const char* others = std::getenv("PATH");
    const std::string path =
        fs::path(program_path()).parent_path().string() + ":" + (others ? others : "");
    ::setenv("PATH", path.c_str(), 1);
  };
  return run({"sh", "-e", "-c", command}, options);
}

/// The pictures go; what is there afterwards is what the commands have drawn.
/// `others` are those that no command draws; `scenes` lie beside the page, as it asks for. Gives
/// what the commands have printed.
std::map<std::string, std::string> expect_pictures_by_commands(
    const std::string& study, std::size_t pictures_of_page, std::size_t least_commands,
    const std::set<std::string>& others, const std::vector<std::string>& options = {},
    const std::vector<fs::path>& scenes = {}) {
  std::map<std::string, std::string> printed;
  const TestFolder folder;
  std::vector<std::string> arguments{"study", study, "--out", "made"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome made = run_fathom(arguments, {.folder = folder.path()});
  EXPECT_EQ(made.status, 0) << made.err;
  if (made.status != 0) return printed;
  const fs::path beside = folder.path() / "made", shown = folder.path() / "shown";
  const std::string page = folder.read("made/index.html");
  EXPECT_EQ(checks::expect_pictures(
                page, [&](const std::string& picture) { return fs::exists(beside / picture); }),
            pictures_of_page);
  EXPECT_TRUE(fs::exists(beside / "summary.json"));
  fs::create_directory(shown);
  for (const fs::path& scene : scenes) fs::copy(scene, beside);
  std::set<std::string> pictures;
  for (const std::string& picture : checks::texts_between(page, "<img src=\"", "\"")) {
    fs::rename(beside / picture, shown / picture);
    pictures.insert(picture);
  }
  const std::vector<std::string> commands = checks::texts_between(page, "<code>", "</code>");
  EXPECT_GE(commands.size(), least_commands);
  for (const std::string& command : commands) {
    // The study itself, which has been run; another renderer, which has tests of its own.
    if (command.starts_with("fathom study ") || command.starts_with("fathom validate ")) continue;
    const Outcome outcome = run_by_shell(unescaped(command), beside);
    EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
    printed[unescaped(command)] = outcome.out;
  }
  for (const std::string& picture : pictures) {
    EXPECT_EQ(fs::exists(beside / picture), !others.contains(picture)) << picture;
    if (fs::exists(beside / picture)) {
      EXPECT_TRUE(folder.read("made/" + picture) == folder.read("shown/" + picture)) << picture;
    }
  }
  return printed;
}

/// What the first command that has this text in it has printed.
std::string printed_by(const std::map<std::string, std::string>& printed, const std::string& text) {
  for (const auto& [command, output] : printed)
    if (command.find(text) != std::string::npos) return output;
  ADD_FAILURE() << "no command has " << text;
  return "";
}

// Some are drawn by exact arithmetic or by the exact engine, as their captions say.
TEST(PageCommands, DrawThePicturesOfTheCourse) {
  if (checks::effort > 1) GTEST_SKIP() << "some sixty renderings, each by a program of its own";
  const auto printed = expect_pictures_by_commands(
      "course", 73, 30,
      {"exercise-2.png", "exercise-6-exact.png", "square-0.png", "square-45.png", "square-90.png",
       "triangles-0.png", "triangles-45.png", "triangles-90.png"});
  // Figures of the page.
  EXPECT_THAT(printed_by(printed, "[[[-20,-20]"), HasSubstr(R"("values":[[0.25]])"));
  EXPECT_THAT(printed_by(printed, "[[[0.5,-28.5]"), HasSubstr(R"("values":[[0.5]])"));
  const std::string by_scan_lines = printed_by(printed, "scan-line triangles.jsonl");
  EXPECT_EQ(std::ranges::count(by_scan_lines, '\n'), 6);
  EXPECT_EQ(by_scan_lines, printed_by(printed, "edge-function triangles.jsonl"));
  EXPECT_EQ(std::ranges::count(printed_by(printed, "squares.jsonl"), '\n'), 3);
  const std::string edge_on = printed_by(printed, "edge-on.obj");
  for (const char* count :
       {R"("front_in_world": 136)", R"("front_in_ndc": 141)", R"("front_in_window": 159)",
        R"("disagreeing": 68)", R"("turned_by_snapping": 137)", R"("front_in_world": 142)",
        R"("front_in_ndc": 142)", R"("front_in_window": 142)", R"("disagreeing": 0)",
        R"("turned_by_snapping": 147)"})
    EXPECT_THAT(edge_on, HasSubstr(count));
}

TEST(PageCommands, DrawThePicturesOfHiddenSurfaces) {
  expect_pictures_by_commands("hidden-surface", 11, 2, {});
}

TEST(PageCommands, DrawThePicturesOfAScenesHiddenSurfaces) {
  expect_pictures_by_commands("hidden-surface", 3, 2, {},
                              {"--scene", source_dir() / "data/meshes/cube.obj"});
}

// Exact pictures are drawn by exact areas, gratings from their samples, the wheel and the curve as
// on the page of the course.
TEST(PageCommands, DrawThePicturesOfAntialiasing) {
  if (checks::effort > 1) GTEST_SKIP() << "the study takes half a minute without sanitizers";
  std::set<std::string> others{"star-truth.png",  "sheets-truth.png",  "wall-truth.png",
                               "plane-truth.png", "wheel-sharp.png",   "wheel-next.png",
                               "coverage.png",    "wheel-shutter.png", "curve-enlarged.png",
                               "curve-anew.png"};
  for (int i = 1; i <= 60; ++i) {
    const std::string thousandths = std::to_string(1000 + 25 * i % 1000);
    others.insert("grating-" + std::to_string(25 * i / 1000) + "." + thousandths.substr(1) +
                  ".png");
  }
  expect_pictures_by_commands("antialiasing", 88, 6, others);
}

// Exact pictures are blended by the judge.
TEST(PageCommands, DrawThePicturesOfBlending) {
  expect_pictures_by_commands(
      "blending", 16, 13,
      {"panes-exact.png", "wall-exact.png", "ring-exact.png", "penetration-exact.png"});
}

TEST(PageCommands, DrawThePicturesOfLenses) {
  expect_pictures_by_commands("lens", 11, 11, {});
}

TEST(PageCommands, DrawThePicturesOfMitigation) {
  expect_pictures_by_commands("mitigation", 7, 7, {});
}

TEST(PageCommands, DrawThePicturesOfAScenesFights) {
  const std::filesystem::path scene = source_dir() / "data/meshes/cube.obj";
  expect_pictures_by_commands("z-fighting", 11, 10, {}, {"--scene", scene}, {scene});
}

// Of the other pages: the plots.
TEST(PageCommands, DrawThePlotsOfLines) {
  expect_pictures_by_commands("lines", 2, 2, {}, {"--samples", "2"});
}

}  // namespace
}  // namespace fathom::test
