// The commands of the course's page, run as its readers run them: each has to draw the page's pictures.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/apps/run_program.h"
#include "tests/apps/test_folder.h"

namespace fathom::test {
namespace {

namespace fs = std::filesystem;

std::string unescaped(std::string text) {
  const std::pair<std::string, std::string> characters[] = {
      {"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}};
  for (const auto& [from, to] : characters) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + 1))
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

TEST(CourseCommands, DrawThePagesPictures) {
  const TestFolder folder;
  ASSERT_EQ(run_fathom({"study", "course", "--out", "course"}, {.folder = folder.path()}).status,
            0);
  const fs::path course = folder.path() / "course", shown = folder.path() / "shown";
  const std::string page = folder.read("course/index.html");

  // The pictures go; what is there afterwards is what the commands have drawn.
  fs::create_directory(shown);
  std::set<std::string> pictures;
  for (const std::string& picture : texts_between(page, "<img src=\"", "\"")) {
    fs::rename(course / picture, shown / picture);
    pictures.insert(picture);
  }
  const std::vector<std::string> commands = texts_between(page, "<code>", "</code>");
  EXPECT_GE(commands.size(), 25U);
  for (const std::string& command : commands) {
    const Outcome outcome = run_by_shell(unescaped(command), course);
    EXPECT_EQ(outcome.status, 0) << command << "\n" << outcome.err;
  }
  // Drawn by exact arithmetic and by the exact engine, as their captions say.
  const std::set<std::string> others{"exercise-2.png", "exercise-6-exact.png"};
  for (const std::string& picture : pictures) {
    EXPECT_EQ(fs::exists(course / picture), !others.contains(picture)) << picture;
    if (fs::exists(course / picture)) {
      EXPECT_TRUE(folder.read("course/" + picture) == folder.read("shown/" + picture)) << picture;
    }
  }
}

}  // namespace
}  // namespace fathom::test
