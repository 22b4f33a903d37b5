// Studies whose pages no test of their commands makes: the pages have all parts, and these are
// among the files.

#include <gtest/gtest.h>

#include <algorithm>

#include "apps/study/study.h"
#include "tests/validation/study/study_page.h"

namespace fathom::studies {
namespace {

std::size_t expect_complete(const std::vector<StudyFile>& files) {
  const auto named = [&](const std::string& name) {
    return std::ranges::find(files, name, &StudyFile::name);
  };
  EXPECT_NE(named("summary.json"), files.end());
  const auto index = named("index.html");
  if (index == files.end()) return 0;
  return checks::expect_pictures(
      index->content, [&](const std::string& name) { return named(name) != files.end(); });
}

std::size_t pictures_of(const std::string& study, const StudyOptions& options = {}) {
  return expect_complete(study_named(study).run(options, [](double) {}));
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
TEST(StudyPages, Subpixel) {
  EXPECT_EQ(pictures_of("subpixel"), 2U);
}
TEST(StudyPages, ZFighting) {
  EXPECT_EQ(pictures_of("z-fighting", {.samples = 2}), 10U);
}

}  // namespace
}  // namespace fathom::studies
