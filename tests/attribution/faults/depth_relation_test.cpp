#include "fathom/attribution/faults/depth_relation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace fathom::attribution {
namespace {

/// 100 depths from 1 to 4 and what another makes of them.
template <class Stored>
std::vector<DepthRelation> relations_of(const Stored& stored) {
  Truth truth;
  truth.camera.near = 0.5;
  truth.camera.far = 20;
  OtherMap other;
  for (int i = 0; i < 100; ++i) {
    truth.depths.push_back(1 + 0.03 * i);
    other.depths.push_back(stored(truth.depths.back()));
  }
  return depth_relations(truth, other);
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
