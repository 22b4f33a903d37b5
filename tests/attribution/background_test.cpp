#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "fathom/attribution/diagnosis.h"
#include "tests/attribution/hand_made.h"
#include "tests/special_values.h"

namespace fathom::attribution {
namespace {

/// A surface at depth 3 in the left half of 20 × 10 pixels.
Truth half_a_sheet() {
  Truth truth = test::truth_of(
      20, 10, [](std::uint32_t column, std::uint32_t) { return column < 10 ? 3 : infinity; });
  truth.camera.near = 1;
  truth.camera.far = 100;
  return truth;
}

/// The background holds `value`.
OtherMap with_background(const Truth& truth, double value) {
  OtherMap map = test::same_as(truth);
  for (double& v : map.values) v = v < infinity ? v : value;
  map.depths = map.values;
  return map;
}

struct BackgroundValue {
  const char* name;
  double value;
  const char* text;
};

void PrintTo(const BackgroundValue& c, std::ostream* stream) {
  *stream << c.name;
}

class Background : public testing::TestWithParam<BackgroundValue> {};

TEST_P(Background, IsToldFromSurfaces) {
  const Truth truth = half_a_sheet();
  const KnownBackground known = known_background(truth, with_background(truth, GetParam().value));
  EXPECT_EQ(known.map.depths, truth.depths);
  ASSERT_TRUE(known.note);
  EXPECT_EQ(known.note->kind, "background");
  EXPECT_EQ(known.note->text, std::string("the background is stored as ") + GetParam().text);
  EXPECT_EQ(known.note->pixels, 100U);
}

INSTANTIATE_TEST_SUITE_P(
    All, Background,
    testing::Values(BackgroundValue{"Zero", 0, "0"}, BackgroundValue{"MinusOne", -1, "-1"},
                    BackgroundValue{"One", 1, "1"},
                    BackgroundValue{"NotANumber", std::numeric_limits<double>::quiet_NaN(), "NaN"},
                    BackgroundValue{"Far", 100.0001, "100.0001, the depth of the far plane"},
                    BackgroundValue{"Greatest", double{std::numeric_limits<float>::max()},
                                    "3.40282347e+38, the greatest binary32"},
                    BackgroundValue{"MinusInfinity", -infinity, "-inf"}),
    [](const auto& c) { return c.param.name; });

TEST(BackgroundOfAMap, ThatIsInfiniteIsOurs) {
  const Truth truth = half_a_sheet();
  const KnownBackground known = known_background(truth, test::same_as(truth));
  EXPECT_FALSE(known.note);
  EXPECT_EQ(known.map.depths, truth.depths);
}

// What is not a number among the surfaces is a hole, whatever the background is.
TEST(BackgroundOfAMap, HolesAreBackgroundToo) {
  const Truth truth = half_a_sheet();
  OtherMap map = with_background(truth, 0);
  map.values[0] = 0;
  map.values[1] = std::numeric_limits<double>::quiet_NaN();
  const KnownBackground known = known_background(truth, map);
  EXPECT_EQ(known.map.depths[0], infinity);
  EXPECT_EQ(known.map.depths[1], infinity);
  EXPECT_EQ(known.map.depths[2], 3);
  ASSERT_TRUE(known.note);
  EXPECT_EQ(known.note->pixels, 102U);
}

TEST(BackgroundOfAMap, StraysInItStay) {
  const Truth truth = half_a_sheet();
  OtherMap map = with_background(truth, 0);
  map.values[15] = 7;
  EXPECT_EQ(known_background(truth, map).map.depths[15], 7);
}

// Stripes that are drawn a pixel too wide on one side: more pixels than those that are clear.
TEST(BackgroundOfAMap, PixelsBesideSurfacesHaveNoSay) {
  for (const bool rows : {true, false}) {
    for (const std::uint32_t wide : {1U, 3U}) {
      const Truth truth = test::truth_of(18, 18, [&](std::uint32_t column, std::uint32_t row) {
        return (rows ? row : column) % 4 == 0 ? 3 : infinity;
      });
      OtherMap map = with_background(truth, 0);
      for (std::uint32_t i = 0; i < 18 * 18; ++i) {
        if ((rows ? i / 18 : i % 18) % 4 == wide) map.values[i] = 3;
      }
      map.values[2 * 18 + 2] = 7;  // a stray, or else there may be as many of either
      const KnownBackground known = known_background(truth, map);
      ASSERT_TRUE(known.note);
      EXPECT_EQ(known.note->text, "the background is stored as 0");
      EXPECT_EQ(known.map.depths[rows ? 18 * wide + 1 : 18 + wide], 3);
    }
  }
}

TEST(BackgroundOfAMap, IsNotGuessed) {
  const Truth truth = half_a_sheet();
  OtherMap differing = with_background(truth, 0);
  for (std::size_t i = 0; i < differing.values.size(); ++i) {
    if (truth.depths[i] == infinity) differing.values[i] = static_cast<double>(i);
  }
  EXPECT_FALSE(known_background(truth, differing).note);

  for (std::size_t i = 0; i < differing.values.size(); i += 3) {
    if (truth.depths[i] == infinity) differing.values[i] = 0;  // a third of them
  }
  EXPECT_FALSE(known_background(truth, differing).note);

  OtherMap unknown = with_background(truth, 0);
  unknown.values.clear();
  EXPECT_FALSE(known_background(truth, unknown).note);
  EXPECT_EQ(known_background(truth, unknown).map.depths, unknown.depths);

  const Truth few = test::truth_of(20, 10, [](std::uint32_t column, std::uint32_t row) {
    return column < 16 || row > 4 ? 3 : infinity;  // 3 × 4 pixels have no surface beside them
  });
  EXPECT_FALSE(known_background(few, with_background(few, 0)).note);
}

}  // namespace
}  // namespace fathom::attribution
