#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "fathom/attribution/raster/raster_polygon.h"

/// Triangles at the borders of the view volume 0 ≤ z ≤ w, −w ≤ x, y ≤ w; here w = 1.
namespace fathom::attribution {
namespace {

using Triangle = std::array<ClipVertex, 3>;

ClipVertex at(double x, double y, double z, double error = 0) {
  return {.value = {x, y, z, 1}, .error = {error, error, error, error}};
}

std::array<const ClipVertex*, 3> corners(const Triangle& t) {
  return {&t[0], &t[1], &t[2]};
}

TEST(CutPolygon, InsideNothingIsCut) {
  const Triangle t{at(-0.5, -0.5, 0.5), at(0.5, -0.5, 0.5), at(0, 0.5, 0.5)};
  EXPECT_TRUE(is_certainly_inside(corners(t)));
  EXPECT_FALSE(is_certainly_outside(corners(t)));
  const std::vector<ClipVertex> whole = cut(corners(t), true);
  ASSERT_EQ(whole.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(whole[i].value, t[i].value);
    EXPECT_EQ(whole[i].borders, 0U);
  }
}

TEST(CutPolygon, OneCornerBeforeTheNearPlaneMakesFour) {
  const Triangle t{at(0, 0, -0.25), at(0.5, 0, 0.75), at(0, 0.5, 0.75)};
  const std::vector<ClipVertex> part = cut(corners(t), false);
  ASSERT_EQ(part.size(), 4U);
  EXPECT_EQ(part[0].value, (std::array<double, 4>{0.125, 0, 0, 1}));
  EXPECT_EQ(part[3].value, (std::array<double, 4>{0, 0.125, 0, 1}));
  // Both lie on the cut: the edge between them is the border's, not the triangle's.
  EXPECT_NE(part[0].borders & part[3].borders, 0U);
  EXPECT_GT(part[0].error[0], 0);
}

TEST(CutPolygon, AtTheImagesBorderOnlyWhereAskedFor) {
  const Triangle t{at(-0.5, 0, 0.5), at(2, -0.5, 0.5), at(2, 0.5, 0.5)};
  EXPECT_EQ(cut(corners(t), false).size(), 3U);
  for (const ClipVertex& v : cut(corners(t), true)) EXPECT_LE(v.value[0], 1);
}

TEST(CutPolygon, CertaintyTakesErrorsIntoAccount) {
  const auto beyond = [](double error) {
    return Triangle{at(1.1, 0, 0.5, error), at(1.2, 0, 0.5, error), at(1.1, 0.5, 0.5, error)};
  };
  EXPECT_TRUE(is_certainly_outside(corners(beyond(0.01))));
  EXPECT_FALSE(is_certainly_outside(corners(beyond(0.1))));
  const Triangle close{at(0.95, 0, 0.5, 0.1), at(0, 0, 0.5), at(0, 0.5, 0.5)};
  EXPECT_FALSE(is_certainly_inside(corners(close)));
}

}  // namespace
}  // namespace fathom::attribution
