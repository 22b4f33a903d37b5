#include "fathom/depth_format/depth_bias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fathom/depth_format/encode.h"

namespace fathom {
namespace {

Ratio ratio(double p, double q = 1) {
  return {Dyadic(p), Dyadic(q)};
}

TEST(DepthBias, UnitOfUnormIsOneStep) {
  EXPECT_EQ(resolvable_difference(Storage::unorm16, ratio(0.25)), ratio(1, 65535));
  EXPECT_EQ(resolvable_difference(Storage::unorm24, Ratio()), ratio(1, 16777215));
}

TEST(DepthBias, UnitOfFloatFollowsTheGreatestExponent) {
  const auto r = [](Storage storage, const Ratio& z) { return resolvable_difference(storage, z); };
  EXPECT_EQ(r(Storage::float32, ratio(1)), ratio(std::ldexp(1.0, -23)));
  EXPECT_EQ(r(Storage::float32, ratio(std::nextafter(1.0, 0.0))), ratio(std::ldexp(1.0, -24)));
  EXPECT_EQ(r(Storage::float32, ratio(0.5)), ratio(std::ldexp(1.0, -24)));
  EXPECT_EQ(r(Storage::float32, ratio(1, 3)), ratio(std::ldexp(1.0, -25)));
  EXPECT_EQ(r(Storage::float32, ratio(-1, 3)), ratio(std::ldexp(1.0, -25)));
  EXPECT_EQ(r(Storage::float16, ratio(0.75)), ratio(std::ldexp(1.0, -11)));
  EXPECT_EQ(r(Storage::float64, ratio(0.75)), ratio(std::ldexp(1.0, -53)));
  // The least step there is, at zero and among the subnormals.
  EXPECT_EQ(r(Storage::float32, Ratio()), ratio(std::ldexp(1.0, -149)));
  EXPECT_EQ(r(Storage::float32, ratio(1e-42)), ratio(std::ldexp(1.0, -149)));
}

TEST(DepthBias, TheQuotedUnitOfUnormIsTooSmall) {
  // x·65535 = 0.5 + 2⁻¹⁷ and (x + 2⁻¹⁶)·65535 = 1.5 − 2⁻¹⁷ are both stored as 1.
  const Ratio x = (ratio(0.5) + ratio(std::ldexp(1.0, -17))) * ratio(1, 65535);
  const Ratio quoted = ratio(std::ldexp(1.0, -16));
  EXPECT_EQ(round_to_storage(Storage::unorm16, x), round_to_storage(Storage::unorm16, x + quoted));
  EXPECT_NE(round_to_storage(Storage::unorm16, x),
            round_to_storage(Storage::unorm16, x + ratio(1, 65535)));
}

TEST(DepthBias, SlopeAndUnitsAdd) {
  const WindowSlopes slopes{ratio(-3, 1000), ratio(1, 1000), ratio(0.5)};
  EXPECT_EQ(depth_offset(Storage::unorm16, {2, 0}, slopes), ratio(6, 1000));
  EXPECT_EQ(depth_offset(Storage::unorm16, {0, -4}, slopes), ratio(-4, 65535));
  EXPECT_EQ(depth_offset(Storage::float32, {-1, 3}, slopes),
            ratio(-3, 1000) + ratio(3 * std::ldexp(1.0, -24)));
}

TEST(DepthBias, ClampLimitsOneSide) {
  const WindowSlopes slopes{ratio(0.25), Ratio(), ratio(0.5)};
  const auto offset = [&](double factor, double clamp) {
    return depth_offset(Storage::unorm16, {factor, 0, clamp}, slopes);
  };
  EXPECT_EQ(offset(2, 0.125), ratio(0.125));
  EXPECT_EQ(offset(-2, 0.125), ratio(-0.5));
  EXPECT_EQ(offset(-2, -0.125), ratio(-0.125));
  EXPECT_EQ(offset(2, -0.125), ratio(0.5));
  EXPECT_EQ(offset(2, 0), ratio(0.5));
  EXPECT_EQ(offset(2, std::numeric_limits<double>::quiet_NaN()), ratio(0.5));
}

TEST(DepthBias, TheResultStaysInTheBuffer) {
  EXPECT_EQ(biased_depth(ratio(0.75), ratio(0.5)), ratio(1));
  EXPECT_EQ(biased_depth(ratio(0.25), ratio(-0.5)), Ratio());
  EXPECT_EQ(biased_depth(ratio(0.25), ratio(0.5)), ratio(0.75));
}

}  // namespace
}  // namespace fathom
