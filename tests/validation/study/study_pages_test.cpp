// Studies that nothing else runs whole: their pages have all parts, and these are among the files.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "apps/study/study.h"
#include "tests/effort.h"

namespace fathom::studies {
namespace {

/// Under each picture stands the command that makes it.
void expect_commands(const std::string& page) {
  const std::string begin = "<figure", end = "</figure>", code = "<figcaption>";
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at + 1)) {
    const std::string figure = page.substr(at, page.find(end, at) - at);
    const std::size_t picture = figure.find("<img src="), caption = figure.find(code);
    if (picture == std::string::npos) continue;
    ASSERT_NE(caption, std::string::npos) << figure;
    const std::string words = figure.substr(caption);
    const bool named = std::ranges::any_of(
        std::array{"fathom ", "fathom-pipeline ", "gnuplot "}, [&](const std::string& program) {
          return words.find(program, words.find("<code>")) != std::string::npos;
        });
    EXPECT_TRUE(words.find("<code>") != std::string::npos && named) << figure;
  }
}

std::size_t expect_complete(const std::vector<StudyFile>& files) {
  const auto named = [&](const std::string& name) {
    return std::find_if(files.begin(), files.end(),
                        [&](const StudyFile& file) { return file.name == name; });
  };
  const auto index = named("index.html");
  if (index == files.end()) return 0;
  const std::string& page = index->content;
  const std::string mark = "<img src=\"";
  std::size_t pictures = 0;
  for (std::size_t at = page.find(mark); at != std::string::npos; at = page.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    const std::string png = page.substr(begin, page.find('"', begin) - begin);
    EXPECT_NE(named(png), files.end()) << png;
    ++pictures;
  }
  EXPECT_NE(named("summary.json"), files.end());
  expect_commands(page);
  return pictures;
}

std::size_t pictures_of(const std::string& study, const StudyOptions& options = {}) {
  return expect_complete(study_named(study).run(options, [](double) {}));
}

TEST(StudyPages, Antialiasing) {
  if (testing::effort > 1) GTEST_SKIP() << "twenty seconds without sanitizers";
  EXPECT_EQ(pictures_of("antialiasing"), 88U);
}
TEST(StudyPages, Blending) {
  EXPECT_EQ(pictures_of("blending"), 16U);
}
TEST(StudyPages, Course) {
  EXPECT_EQ(pictures_of("course"), 73U);
}
TEST(StudyPages, HiddenSurface) {
  EXPECT_EQ(pictures_of("hidden-surface"), 11U);
}
TEST(StudyPages, Lens) {
  EXPECT_EQ(pictures_of("lens"), 11U);
}
TEST(StudyPages, Lines) {
  EXPECT_EQ(pictures_of("lines", {.samples = 2}), 2U);
}

TEST(StudyPages, Clipping) {
  EXPECT_EQ(pictures_of("clipping", {.samples = 2}), 5U);
}
TEST(StudyPages, DepthResolution) {
  EXPECT_EQ(pictures_of("depth-resolution", {.samples = 5}), 8U);
}
TEST(StudyPages, Indistinguishable) {
  EXPECT_EQ(pictures_of("indistinguishable", {.samples = 101}), 6U);
}
TEST(StudyPages, Mitigation) {
  EXPECT_EQ(pictures_of("mitigation"), 7U);
}
TEST(StudyPages, Subpixel) {
  EXPECT_EQ(pictures_of("subpixel"), 2U);
}
TEST(StudyPages, ZFighting) {
  EXPECT_EQ(pictures_of("z-fighting", {.samples = 2}), 10U);
}

}  // namespace
}  // namespace fathom::studies
