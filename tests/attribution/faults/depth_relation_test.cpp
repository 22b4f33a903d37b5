#include "fathom/attribution/faults/depth_relation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace fathom::attribution {
namespace {

/// 100 depths from 1 to 4, which are no multiples of a code, and what another makes of them.
struct TwoMaps {
  Truth truth;
  OtherMap other;
};
template <class Stored>
TwoMaps maps_of(const Stored& stored) {
  TwoMaps maps;
  maps.truth.camera.near = 0.5;
  maps.truth.camera.far = 20;
  for (int i = 0; i < 100; ++i) {
    maps.truth.depths.push_back(1 + i / std::sqrt(1100.0));
    maps.other.depths.push_back(stored(maps.truth.depths.back()));
  }
  return maps;
}

template <class Stored>
std::vector<DepthRelation> relations_of(const Stored& stored) {
  const TwoMaps maps = maps_of(stored);
  return depth_relations(maps.truth, maps.other);
}

TEST(DepthRelation, NamesTheFormula) {
  const auto millimetres = relations_of([](double d) { return 1000 * d; });
  ASSERT_FALSE(millimetres.empty());
  EXPECT_EQ(millimetres[0].kind, "scale");
  EXPECT_EQ(millimetres[0].pixels, 100U);
  EXPECT_EQ(millimetres[0].recorded.factor, 1000);
  EXPECT_THAT(millimetres[0].text, testing::HasSubstr("stored = 1000·depth (millimetres"));
  const auto disparity = relations_of([](double d) { return 2 - 1 / d; });
  ASSERT_FALSE(disparity.empty());
  EXPECT_THAT(disparity[0].text, testing::HasSubstr("stored = -1/depth + 2"));
  const auto logarithm = relations_of([](double d) { return std::log(d) / std::log(10.0); });
  ASSERT_FALSE(logarithm.empty());
  EXPECT_EQ(logarithm[0].kind, "decoding");
}

TEST(DepthRelation, WritesSignsAndLeavesOutLostTerms) {
  const auto text = [](auto stored) {
    const auto found = relations_of(stored);
    return found.empty() ? "" : found[0].text;
  };
  EXPECT_THAT(text([](double d) { return 0.1001 / d - 0.001001; }),
              testing::HasSubstr("stored = 0.1001/depth - 0.001001"));
  EXPECT_THAT(text([](double d) { return 3 / d + 1e-12; }), testing::EndsWith("stored = 3/depth"));
  EXPECT_THAT(text([](double d) { return 1 - 1e-9 * d; }),
              testing::StartsWith("the channel hardly depends on depth: it is 1 nearly everywhere; "
                                  "expected the channel of depths"));
  EXPECT_EQ(text([](double) { return 1.0; }), "");
}

TEST(DepthRelation, SaysWhatTheConstantsMean) {
  const double a = 20 / 19.5, b = -10 / 19.5;  // of near 0.5 and far 20
  const auto window = relations_of([&](double d) { return a + b / d; });
  ASSERT_FALSE(window.empty());
  EXPECT_THAT(window[0].text, testing::HasSubstr("(0 at near and 1 at far)"));
  const auto ndc = relations_of([&](double d) { return 2 * (a + b / d) - 1; });
  ASSERT_FALSE(ndc.empty());
  EXPECT_THAT(ndc[0].text, testing::HasSubstr("z of −1 at near"));
  const auto planes = relations_of([&](double d) {
    const double z = a + b / d;
    return 10 / (10 - 9 * z);  // decoded with near 1 and far 10
  });
  ASSERT_FALSE(planes.empty());
  EXPECT_THAT(
      planes[0].text,
      testing::HasSubstr("(decoded with near 1 and far 10 if drawn with near 0.5 and far 20)"));
}

TEST(DepthRelation, FindsCodes) {
  const auto millimetres = relations_of([](double d) { return std::round(1000 * d); });
  ASSERT_FALSE(millimetres.empty());
  EXPECT_EQ(millimetres[0].recorded.rounding, RecordedDepth::Rounding::nearest);
  EXPECT_EQ(millimetres[0].recorded.step, 1);
  EXPECT_EQ(millimetres[0].recorded.factor, 1000);
}

struct Scales {
  double stored, read;
};

void PrintTo(const Scales& scales, std::ostream* stream) {
  *stream << scales.stored << " read as " << scales.read;
}

/// Depths in codes of one scale, read with another.
template <class Round>
std::vector<DepthRelation> relations_of_codes(const Scales& scales, const Round& round) {
  TwoMaps maps = maps_of([&](double d) { return round(scales.stored * d) / scales.read; });
  maps.other.code_scale = scales.read;
  return depth_relations(maps.truth, maps.other);
}

class ScaleOfCodes : public testing::TestWithParam<Scales> {};

TEST_P(ScaleOfCodes, IsMeasured) {
  const auto found = relations_of_codes(GetParam(), [](double code) { return std::round(code); });
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, "scale");
  EXPECT_TRUE(found[0].excludes_camera);
  EXPECT_EQ(found[0].recorded.rounding, RecordedDepth::Rounding::nearest);
  EXPECT_EQ(found[0].recorded.step, 1 / GetParam().read);
  EXPECT_EQ(found[0].recorded.factor, GetParam().stored / GetParam().read);
  EXPECT_THAT(found[0].text, testing::EndsWith(fmt::format(
                                 ": a unit has {} codes, not {}; --png-scale {} reads "
                                 "them",
                                 GetParam().stored, GetParam().read, GetParam().stored)));
  ASSERT_EQ(found[0].estimates.size(), 1U);
  EXPECT_EQ(found[0].estimates[0].name, "factor");
  EXPECT_EQ(found[0].estimates[0].value, GetParam().stored / GetParam().read);
}

TEST_P(ScaleOfCodes, IsMeasuredIfCodesAreRoundedDown) {
  const auto found = relations_of_codes(GetParam(), [](double code) { return std::floor(code); });
  const auto down = std::ranges::find_if(found, [](const DepthRelation& relation) {
    return relation.recorded.rounding == RecordedDepth::Rounding::down;
  });
  ASSERT_NE(down, found.end());
  EXPECT_EQ(down->recorded.factor, GetParam().stored / GetParam().read);
  EXPECT_THAT(down->text, testing::HasSubstr(", rounded down: a unit has "));
}

INSTANTIATE_TEST_SUITE_P(DepthRelation, ScaleOfCodes,
                         testing::Values(Scales{1000, 5000}, Scales{5000, 1000}, Scales{256, 1000},
                                         Scales{1000, 256}, Scales{100, 1000}, Scales{10000, 1000},
                                         Scales{1000, 900}));

TEST(DepthRelation, FindsCodesOfAnyStep) {
  const auto found = relations_of([](double d) { return std::round(100 * d) / 70; });
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(found[0].recorded.step, 1 / 70.0, 1e-12);
  EXPECT_THAT(found[0].text, testing::EndsWith(", in codes of 1/70"));
}

// Thirds of a unit are in no list.
TEST(DepthRelation, GivesTheFactorThatIsMeasured) {
  const auto found = relations_of([](double d) { return d / 3; });
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].text, "depths are scaled: stored = 0.333333·depth");
  EXPECT_NEAR(found[0].recorded.factor, 1 / 3.0, 1e-12);
}

TEST(DepthRelation, OfRightDepthsThereIsNone) {
  EXPECT_TRUE(relations_of([](double d) { return d; }).empty());
  EXPECT_TRUE(relations_of([](double d) { return double{static_cast<float>(d)}; }).empty());
  EXPECT_TRUE(relations_of([](double d) { return std::round(500 * d) / 500; }).empty());
}

// Any two constants fit two depths.
TEST(DepthRelation, TwoConstantsNeedSeveralDepths) {
  TwoMaps maps = maps_of([](double d) { return d; });
  for (std::size_t i = 0; i < maps.truth.depths.size(); ++i) {
    maps.truth.depths[i] = 1 + static_cast<double>(i % 2);
    maps.other.depths[i] = 7 - maps.truth.depths[i];
  }
  EXPECT_TRUE(depth_relations(maps.truth, maps.other).empty());
}

TEST(DepthRelation, DescribesOtherFunctionsOfTheDepth) {
  const auto curve_of = [](const auto& stored) {
    const TwoMaps maps = maps_of(stored);
    return text_of_curve(maps.truth, maps.other).value_or("");
  };
  EXPECT_THAT(
      curve_of([](double d) { return std::sin(d / 3); }),
      testing::StartsWith("the map stores a function of the depth, which rises with it, and "
                          "no model explains it: 0.3"));
  EXPECT_THAT(curve_of([](double d) { return std::cos(d / 3); }),
              testing::HasSubstr("which falls with it"));
  EXPECT_EQ(curve_of([](double d) { return 1.001 * d; }), "");
  EXPECT_EQ(curve_of([](double d) { return d + 0.5 * std::sin(40 * d); }), "");
  EXPECT_EQ(curve_of([](double) { return 7.0; }), "");
}

TEST(DepthRelation, AFewPixelsMayBeOtherwise) {
  int count = 0;
  const auto found = relations_of([&](double d) { return ++count % 33 == 0 ? 7.0 : 2 * d; });
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].kind, "scale");
  EXPECT_GE(found[0].pixels, 97U);
}

TEST(DepthRelation, NoiseHasNone) {
  std::uint32_t seed = 1;
  EXPECT_TRUE(
      relations_of([&](double) { return (seed = 1664525 * seed + 1013904223) * 1e-9; }).empty());
  EXPECT_TRUE(relations_of([](double) { return std::numeric_limits<double>::infinity(); }).empty());
}

}  // namespace
}  // namespace fathom::attribution
