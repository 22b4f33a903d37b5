#include "fathom/triangle/referee.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/inputs/scene_building.h"

namespace fathom {
namespace {

using namespace triangle;

/// Two triangles that cross along a line through the sample (4.5, 4.5), where their depth is 2; a
/// copy of the first, and one behind it.
Scene crossing_scene() {
  return checks::scene_of({{-2, -2, 2},
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
  Camera c = checks::camera_of(9, 9, 2);
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

}  // namespace
}  // namespace fathom
