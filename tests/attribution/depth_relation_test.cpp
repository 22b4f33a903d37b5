#include "fathom/attribution/faults/depth_relation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

namespace fathom::attribution {
namespace {

/// 100 depths from 1 to 4 and what another makes of them.
template <class Stored>
std::optional<Finding> relation_of(const Stored& stored) {
  Truth truth;
  OtherMap other;
  for (int i = 0; i < 100; ++i) {
    truth.depths.push_back(1 + 0.03 * i);
    other.depths.push_back(stored(truth.depths.back()));
  }
  return related_depths(truth, other);
}

TEST(DepthRelation, NamesTheFormula) {
  const auto millimetres = relation_of([](double d) { return 1000 * d; });
  ASSERT_TRUE(millimetres);
  EXPECT_EQ(millimetres->kind, "scale");
  EXPECT_EQ(millimetres->pixels, 100U);
  EXPECT_THAT(millimetres->text, testing::HasSubstr("stored = 1000·depth"));
  const auto disparity = relation_of([](double d) { return 2 - 1 / d; });
  ASSERT_TRUE(disparity);
  EXPECT_THAT(disparity->text, testing::HasSubstr("stored = -1/depth + 2"));
  const auto logarithm = relation_of([](double d) { return std::log(d) / std::log(10.0); });
  ASSERT_TRUE(logarithm);
  EXPECT_EQ(logarithm->kind, "decoding");
}

TEST(DepthRelation, AFewPixelsMayBeOtherwise) {
  int count = 0;
  const auto found = relation_of([&](double d) { return ++count % 33 == 0 ? 7.0 : 2 * d; });
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, "scale");
  EXPECT_EQ(found->pixels, 97U);
}

TEST(DepthRelation, NoiseHasNone) {
  std::uint32_t seed = 1;
  EXPECT_FALSE(relation_of([&](double) { return (seed = 1664525 * seed + 1013904223) * 1e-9; }));
  EXPECT_FALSE(relation_of([](double) { return std::numeric_limits<double>::infinity(); }));
}

}  // namespace
}  // namespace fathom::attribution
