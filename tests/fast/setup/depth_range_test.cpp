#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fathom/fast/setup/setup.h"
#include "fathom/numeric/ratio.h"
#include "tests/inputs/scene_building.h"

namespace fathom {
namespace {

using namespace fast;

/// The ends enclose 1/limit and −limit: exactly compared, and next to them.
TEST(DepthRange, PerspectiveLimitsEncloseTheReciprocals) {
  Camera c = checks::camera_of(9, 9, 2);
  for (const double limit : {0.1, 1.0, 3.0, 7.0, 0x1.fffffffffffffp+3, 1e-30, 1e30}) {
    const Dyadic one(1.0);
    c.near = limit;
    c.far = limit * 1.5;
    const DepthRange range = depth_range(c);
    EXPECT_LT(Dyadic(range.inside_greatest) * Dyadic(c.near), one);
    EXPECT_GT(Dyadic(range.outside_greatest) * Dyadic(c.near), one);
    EXPECT_GT(Dyadic(range.inside_least) * Dyadic(c.far), one);
    EXPECT_LT(Dyadic(range.outside_least) * Dyadic(c.far), one);
    EXPECT_LT(range.outside_greatest / range.inside_greatest, 1 + 0x1p-50);
    EXPECT_LT(range.inside_least / range.outside_least, 1 + 0x1p-50);
  }
}

/// Reciprocals that overflow, and those that are subnormal.
TEST(DepthRange, ReciprocalsBeyondTheNormalNumbersAreEnclosed) {
  Camera c = checks::camera_of(9, 9, 2);
  constexpr double greatest = std::numeric_limits<double>::max();
  for (const double limit : {0x1p-1074, 0x1.8p-1030, 0x1p-1024, 0x1.0000000000004p-1024, 0x1p-1023,
                             0x1p1022, 0x1.8p1023, greatest}) {
    SCOPED_TRACE(::testing::Message() << std::hexfloat << limit);
    const Dyadic one(1.0);
    c.near = c.far = limit;
    const DepthRange range = depth_range(c);
    EXPECT_LT(Dyadic(range.inside_greatest) * Dyadic(limit), one);
    EXPECT_LT(Dyadic(range.outside_least) * Dyadic(limit), one);
    for (const double above : {range.outside_greatest, range.inside_least}) {
      if (std::isfinite(above)) {
        EXPECT_GT(Dyadic(above) * Dyadic(limit), one);
      } else {
        EXPECT_GE(compare(Ratio(1.0, limit), Dyadic(greatest)), 0);
      }
    }
  }
}

TEST(DepthRange, WithoutLimitsEverythingInFrontCounts) {
  Camera c = checks::camera_of(9, 9, 2);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(depth_range(c).certainly_contains(-infinity, infinity));
  c.projection.model = ProjectionModel::orthographic;  // q = −D
  EXPECT_TRUE(depth_range(c).certainly_contains(-infinity, -0x1p-1074));
  EXPECT_FALSE(depth_range(c).certainly_contains(-1, 0));
  EXPECT_FALSE(depth_range(c).certainly_misses(0, 0));  // not known: asked exactly
  EXPECT_TRUE(depth_range(c).certainly_misses(0x1p-1074, 1));
}

TEST(DepthRange, OrthographicLimitsAreTheNegatedDepths) {
  Camera c = checks::camera_of(9, 9, 2);
  c.projection.model = ProjectionModel::orthographic;
  c.near = 2;
  c.far = 4;
  const DepthRange range = depth_range(c);
  EXPECT_TRUE(range.certainly_contains(-4, -2));
  EXPECT_FALSE(range.certainly_contains(std::nextafter(-4, -9), -2));
  EXPECT_FALSE(range.certainly_contains(-4, std::nextafter(-2, 0)));
  EXPECT_TRUE(range.certainly_misses(-9, std::nextafter(-4, -9)));
  EXPECT_TRUE(range.certainly_misses(std::nextafter(-2, 0), 1));
  EXPECT_FALSE(range.certainly_misses(-2, 1));
}

}  // namespace
}  // namespace fathom
