// Studies that nothing else runs whole: their pages have all parts, and these are among the files.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/effort.h"
#include "validation/studies/study.h"

namespace fathom::studies {
namespace {

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
  EXPECT_EQ(pictures_of("course"), 70U);
}
TEST(StudyPages, HiddenSurface) {
  EXPECT_EQ(pictures_of("hidden-surface"), 11U);
}
TEST(StudyPages, Lines) {
  EXPECT_EQ(pictures_of("lines", {.samples = 2}), 2U);
}

}  // namespace
}  // namespace fathom::studies
