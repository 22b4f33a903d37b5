// The commands of the pages, run as their readers run them: they have to draw the pages' pictures.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"
#include "tests/effort.h"

namespace fathom::test {
namespace {

namespace fs = std::filesystem;

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

/// All that stands between two marks.
std::vector<std::string> texts_between(const std::string& page, const std::string& begin,
                                       const std::string& end) {
  std::vector<std::string> texts;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    texts.push_back(page.substr(at, page.find(end, at) - at));
  }
  return texts;
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
/// `others` are those that no command draws.
void expect_pictures_by_commands(const std::string& study, std::size_t least_commands,
                                 const std::set<std::string>& others) {
  const TestFolder folder;
  const Outcome made = run_fathom({"study", study, "--out", "made"}, {.folder = folder.path()});
  ASSERT_EQ(made.status, 0) << made.err;
  const fs::path beside = folder.path() / "made", shown = folder.path() / "shown";
  const std::string page = folder.read("made/index.html");
  fs::create_directory(shown);
  std::set<std::string> pictures;
  for (const std::string& picture : texts_between(page, "<img src=\"", "\"")) {
    fs::rename(beside / picture, shown / picture);
    pictures.insert(picture);
  }
  const std::vector<std::string> commands = texts_between(page, "<code>", "</code>");
  EXPECT_GE(commands.size(), least_commands);
  for (const std::string& command : commands) {
    const Outcome outcome = run_by_shell(unescaped(command), beside);
    EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
  }
  for (const std::string& picture : pictures) {
    EXPECT_EQ(fs::exists(beside / picture), !others.contains(picture)) << picture;
    if (fs::exists(beside / picture)) {
      EXPECT_TRUE(folder.read("made/" + picture) == folder.read("shown/" + picture)) << picture;
    }
  }
}

// Two are drawn by exact arithmetic and by the exact engine, as their captions say.
TEST(PageCommands, DrawThePicturesOfTheCourse) {
  if (testing::effort > 1) GTEST_SKIP() << "some sixty renderings, each by a program of its own";
  expect_pictures_by_commands("course", 25, {"exercise-2.png", "exercise-6-exact.png"});
}

TEST(PageCommands, DrawThePicturesOfHiddenSurfaces) {
  expect_pictures_by_commands("hidden-surface", 1, {"cost.png"});
}

}  // namespace
}  // namespace fathom::test
