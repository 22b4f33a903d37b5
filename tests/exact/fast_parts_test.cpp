// The referee and the limits of the depth range, by themselves.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fathom/fast/depth_range.h"
#include "fathom/triangle/referee.h"
#include "tests/exact/scene_building.h"

namespace fathom {
namespace {

/// Two triangles that cross along a line through the sample (4.5, 4.5), where their depth is 2; a
/// copy of the first, and one behind it.
Scene crossing_scene() {
  return testing::scene_of({{-2, -2, 2},
                            {2, -2, 2},
                            {0, 3, 2},  // depth 2
                            {-2, -2, 1},
                            {2, -2, 3},
                            {0, 3, 2},  // depth 2 + x/2
                            {-4, -4, 4},
                            {4, -4, 4},
                            {0, 6, 4}},
                           {{0, 1, 2}, {3, 4, 5}, {2, 0, 1}, {6, 7, 8}});
}

Camera camera() {
  Camera c = testing::camera_of(9, 9, 2);
  c.near = 2;
  c.far = 4;
  return c;
}

TEST(Referee, EqualDepthsGoToTheLowerNumberInEitherOrder) {
  const Scene scene = crossing_scene();
  const Camera c = camera();
  Referee referee(scene, c);
  RenderStatistics statistics;
  const ImagePoint middle{4.5, 4.5};
  EXPECT_TRUE(referee.hides(0, 1, middle, statistics));
  EXPECT_FALSE(referee.hides(1, 0, middle, statistics));
  EXPECT_EQ(statistics.same_plane, 0U);
  // In one plane: 0 and its copy 2.
  EXPECT_TRUE(referee.hides(0, 2, middle, statistics));
  EXPECT_FALSE(referee.hides(2, 0, middle, statistics));
  EXPECT_EQ(statistics.same_plane, 2U);
  EXPECT_EQ(statistics.visibility.exact, 4U);
}

TEST(Referee, TheNearerHidesWhateverItsNumber) {
  const Scene scene = crossing_scene();
  const Camera c = camera();
  Referee referee(scene, c);
  RenderStatistics statistics;
  EXPECT_TRUE(referee.hides(1, 0, {3.5, 4.5}, statistics));
  EXPECT_FALSE(referee.hides(0, 1, {3.5, 4.5}, statistics));
  EXPECT_TRUE(referee.hides(0, 1, {5.5, 4.5}, statistics));
  EXPECT_FALSE(referee.hides(1, 0, {5.5, 4.5}, statistics));
  EXPECT_FALSE(referee.hides(3, 2, {5.5, 4.5}, statistics));
}

TEST(Referee, DepthsOnTheLimitsCount) {
  const Scene scene = crossing_scene();
  const Camera c = camera();
  RenderStatistics statistics;
  Referee referee(scene, c);
  const ImagePoint middle{4.5, 4.5};
  EXPECT_TRUE(referee.is_in_range(0, middle, statistics));       // near = 2
  EXPECT_TRUE(referee.is_in_range(3, middle, statistics));       // far = 4
  EXPECT_FALSE(referee.is_in_range(1, {3.5, 4.5}, statistics));  // below near
  Camera closer = c;
  closer.far = std::nextafter(4.0, 0);
  EXPECT_FALSE(Referee(scene, closer).is_in_range(3, middle, statistics));
}

/// The ends enclose 1/limit and −limit: exactly compared, and next to them.
TEST(DepthRange, PerspectiveLimitsEncloseTheReciprocals) {
  Camera c = testing::camera_of(9, 9, 2);
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

TEST(DepthRange, WithoutLimitsEverythingInFrontCounts) {
  Camera c = testing::camera_of(9, 9, 2);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(depth_range(c).certainly_contains(-infinity, infinity));
  c.projection = Projection::orthographic;  // q = −D
  EXPECT_TRUE(depth_range(c).certainly_contains(-infinity, -0x1p-1074));
  EXPECT_FALSE(depth_range(c).certainly_contains(-1, 0));
  EXPECT_FALSE(depth_range(c).certainly_misses(0, 0));  // not known: asked exactly
  EXPECT_TRUE(depth_range(c).certainly_misses(0x1p-1074, 1));
}

TEST(DepthRange, OrthographicLimitsAreTheNegatedDepths) {
  Camera c = testing::camera_of(9, 9, 2);
  c.projection = Projection::orthographic;
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
