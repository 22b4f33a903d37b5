#include "fathom/image/sample_pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "fathom/failures/errors.h"
#include "tests/inputs/sample_patterns.h"

namespace fathom {
namespace {

using checks::all_patterns;

TEST(SamplePattern, PositionsAreThoseOfTheInterfaces) {
  for (const std::string& name : all_patterns) {
    const SamplePattern pattern = sample_pattern(name);
    std::set<SampleOffset> places;
    for (std::size_t k = 0; k < pattern.count(); ++k) {
      const SampleOffset at = pattern.at(k, 3, 4);
      for (const double x : at) {
        EXPECT_GE(x, -0.5);
        EXPECT_LT(x, 0.5);
        EXPECT_EQ(std::ldexp(x, 20), std::round(std::ldexp(x, 20))) << name;
      }
      places.insert(at);
    }
    EXPECT_EQ(places.size(), pattern.count()) << name;
  }
  // No two samples of a standard pattern share a row or a column.
  for (const char* name : {"2", "4", "8", "16", "rotated-grid"}) {
    std::set<double> columns, rows;
    const SamplePattern pattern = sample_pattern(name);
    for (const auto& [u, v] : pattern.offsets) {
      columns.insert(u);
      rows.insert(v);
    }
    EXPECT_EQ(columns.size(), pattern.count()) << name;
    EXPECT_EQ(rows.size(), pattern.count()) << name;
  }
}

/// One source prints a rotated grid whose mean is (1/16, 0), another a regular grid of spacing
/// 1/(n + 1), which leaves a border without samples.
TEST(SamplePattern, TheGridsAreCentredAndEven) {
  for (const char* name : {"rotated-grid", "regular:2", "regular:4", "regular:8"}) {
    double u = 0, v = 0;
    for (const auto& offset : sample_pattern(name).offsets) {
      u += offset[0];
      v += offset[1];
    }
    EXPECT_EQ(u, 0) << name;
    EXPECT_EQ(v, 0) << name;
  }
  const auto& four = sample_pattern("regular:4").offsets;
  EXPECT_EQ(four[0][0], -0.375);
  EXPECT_EQ(four[1][0] - four[0][0], 0.25);
  EXPECT_EQ(four[4][1] - four[0][1], 0.25);
}

TEST(SamplePattern, JitterStaysInItsCellAndFollowsItsSeed) {
  const SamplePattern a = sample_pattern("jittered:4:1"), b = sample_pattern("jittered:4"),
                      other = sample_pattern("jittered:4:2");
  bool pixels_differ = false, seeds_differ = false;
  for (std::size_t k = 0; k < 16; ++k) {
    for (std::uint32_t column = 0; column < 20; ++column) {
      const SampleOffset at = a.at(k, column, 5);
      EXPECT_EQ(at, b.at(k, column, 5));
      for (std::size_t i = 0; i < 2; ++i) {
        const double cell = static_cast<double>(i == 0 ? k % 4 : k / 4) / 4 - 0.5;
        EXPECT_GE(at[i], cell);
        EXPECT_LT(at[i], cell + 0.25);
      }
      pixels_differ = pixels_differ || at != a.at(k, column + 1, 5);
      seeds_differ = seeds_differ || at != other.at(k, column, 5);
    }
  }
  EXPECT_TRUE(pixels_differ);
  EXPECT_TRUE(seeds_differ);
}

TEST(SamplePattern, OthersDoNotExist) {
  for (const char* name : {"", "3", "0", "32", "regular", "regular:", "regular:3",
                           "jittered:4:", "jittered:4:x", "rotated-grid:4", "Regular:4", "4 "}) {
    EXPECT_THROW(sample_pattern(name), UsageError) << name;
  }
}

}  // namespace
}  // namespace fathom
