#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "fathom/attribution/faults/local_faults.h"
#include "tests/attribution/hand_made.h"
#include "tests/special_values.h"

namespace fathom::attribution {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t width = 60, height = 40;

/// A slope, nearer at the left, with a step to twice the depth in the middle of its rows.
double slope(std::uint32_t column, std::uint32_t row) {
  return (2 + 0.05 * column) * (row < height / 2 ? 1 : 2);
}

struct Image {
  Truth truth = test::truth_of(width, height, slope);
  OtherMap other = test::same_as(truth);
  Attribution found = test::all_equal(truth);

  void set(std::size_t pixel, double depth) {
    other.depths[pixel] = depth;
    test::set_unexplained(found, pixel);
  }
};

/// The pixels that are explained.
std::size_t count(const PixelFinding& f) {
  return static_cast<std::size_t>(std::count(f.explained.begin(), f.explained.end(), 1));
}

TEST(Isolated, OnePixel) {
  Image image;
  image.set(5 * width + 7, infinity);
  const auto found = isolated(image.truth, image.other, image.found);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->finding.kind, "isolated-pixels");
  EXPECT_EQ(found->finding.pixels, 1U);
  EXPECT_EQ(found->finding.text, "a pixel is wrong by itself; (7, 5) shows background for 2.35");
  EXPECT_EQ(count(*found), 1U);
  EXPECT_EQ(found->explained[5 * width + 7], 1);
}

TEST(Isolated, Five) {
  Image image;
  for (std::size_t k = 1; k <= 5; ++k) image.set(k * (width + 7), 0.5);
  const auto found = isolated(image.truth, image.other, image.found);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->finding.pixels, 5U);
  EXPECT_THAT(found->finding.text,
              HasSubstr("5 pixels are wrong by themselves; the first at (7, 1)"));
}

TEST(Isolated, FourTogetherAreAndFiveAreNot) {
  Image image;
  for (std::size_t k = 0; k < 4; ++k) image.set(300 + k, 0.5);
  EXPECT_TRUE(isolated(image.truth, image.other, image.found));
  image.set(304, 0.5);
  EXPECT_FALSE(isolated(image.truth, image.other, image.found));
}

TEST(Isolated, NoneAndTooMany) {
  Image image;
  EXPECT_FALSE(isolated(image.truth, image.other, image.found));
  for (std::size_t i = 0; i < 48; ++i) image.set((i / 12) * 3 * width + i % 12 * 3, 0.5);
  EXPECT_TRUE(isolated(image.truth, image.other, image.found));  // a fiftieth
  image.set(20 * width, 0.5);
  EXPECT_FALSE(isolated(image.truth, image.other, image.found));
}

TEST(LostLines, Rows) {
  Image image;
  for (const std::size_t row : {11U, 12U, 17U}) {
    for (std::size_t x = 0; x < width; ++x) image.set(row * width + x, infinity);
  }
  const auto found = lost_lines(image.truth, image.other, image.found);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->finding.kind, "lost-rows");
  EXPECT_EQ(found->finding.pixels, 3U * width);
  EXPECT_EQ(found->finding.text, "3 rows from 11 to 17 do not show what they should");
  EXPECT_EQ(count(*found), 3U * width);
}

TEST(LostLines, AColumnMostOfWhichIsLost) {
  Image image;
  for (std::size_t y = 0; y < 37; ++y) image.set(y * width + 59, 1);
  image.set(0, 1);  // one that is not of it, which is less than a tenth
  const auto found = lost_lines(image.truth, image.other, image.found);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->finding.kind, "lost-columns");
  EXPECT_EQ(found->finding.text, "column 59 does not show what it should");
  EXPECT_EQ(count(*found), 37U);
  EXPECT_EQ(found->explained[0], 0);
}

TEST(LostLines, AreNotLostWhereLessOfThemIs) {
  Image image;
  for (std::size_t y = 0; y < 35; ++y) image.set(y * width + 59, 1);  // of 40
  EXPECT_FALSE(lost_lines(image.truth, image.other, image.found));
  for (std::size_t i = 0; i < image.truth.depths.size(); ++i) {
    if (image.found.classes[i] == PixelClass::equal) image.set(i, 1);
  }
  EXPECT_FALSE(lost_lines(image.truth, image.other, image.found));  // nothing is as it should be
}

TEST(Clipped, NearAndFar) {
  for (const bool is_near : {true, false}) {
    Image image;
    for (std::size_t i = 0; i < image.truth.depths.size(); ++i) {
      const double depth = image.truth.depths[i];
      if (is_near ? depth < 2.42 : depth > 8.5) image.set(i, infinity);
    }
    const auto found = clipped(image.truth, image.other, image.found);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->finding.kind, "clipped");
    // A thousandth of the pixels on either side is left to edges.
    EXPECT_EQ(found->finding.text, is_near ? "surfaces nearer than 2.45 are missing"
                                           : "surfaces farther than 8.5 are missing");
    EXPECT_EQ(found->finding.pixels, image.found.count(PixelClass::unexplained));
  }
}

TEST(Clipped, IsOnlyWhatIsMissing) {
  Image nearer;
  for (std::size_t i = 0; i < nearer.truth.depths.size(); ++i) {
    if (nearer.truth.depths[i] < 2.42) nearer.set(i, 1);  // something else is before them
  }
  EXPECT_FALSE(clipped(nearer.truth, nearer.other, nearer.found));
  Image between;
  for (std::size_t i = 0; i < between.truth.depths.size(); ++i) {
    const double depth = between.truth.depths[i];
    if (depth > 3 && depth < 4) between.set(i, infinity);
  }
  EXPECT_FALSE(clipped(between.truth, between.other, between.found));
}

/// The mean of the two rows at the step, as a filter makes it.
void blur(Image& image) {
  for (std::size_t x = 0; x < width; ++x) {
    const std::size_t above = (height / 2 - 1) * width + x, below = above + width;
    const double mean = (image.truth.depths[above] + image.truth.depths[below]) / 2;
    image.set(above, mean);
    image.set(below, mean);
  }
}

TEST(Mixed, AFilterIs) {
  Image image;
  blur(image);
  const auto found = mixed(image.truth, image.other, image.found);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->finding.kind, "mixed");
  EXPECT_EQ(found->finding.pixels, 2U * width);
}

// Depths that are off by a thousandth lie between those of the neighbours, too.
TEST(Mixed, WhatIsOffEverywhereIsNot) {
  Image image;
  for (std::size_t i = 0; i < image.truth.depths.size(); ++i) {
    image.set(i, image.truth.depths[i] * 1.001);
  }
  EXPECT_FALSE(mixed(image.truth, image.other, image.found));
}

TEST(Mixed, OtherSurfacesAreNot) {
  Image image;
  blur(image);
  for (double& depth : image.other.depths) {
    if (std::find(image.truth.depths.begin(), image.truth.depths.end(), depth) ==
        image.truth.depths.end()) {
      depth = 0.5;
    }
  }
  EXPECT_FALSE(mixed(image.truth, image.other, image.found));
}

}  // namespace
}  // namespace fathom::attribution
