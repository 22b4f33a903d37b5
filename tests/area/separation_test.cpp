// How far one plane lies behind another over a pixel: values known on paper.
#include <gtest/gtest.h>

#include <cmath>

#include "fathom/area/surface_pairs.h"
#include "tests/area/surfaces.h"

namespace fathom {
namespace {

using namespace area;
using checks::plain_camera;
using checks::scene_of;
using checks::surfaces_of;

/// Two planes z = f(x, y) over the pixel (0, 0) of a camera, the first in front.
struct Planes {
  template <class Front, class Behind>
  Planes(const Camera& camera, const Front& front, const Behind& behind)
      : surfaces(surfaces_of(scene_of({at(-1, -1, front), at(5, -1, front), at(-1, 5, front),
                                       at(-1, -1, behind), at(5, -1, behind), at(-1, 5, behind)},
                                      {{0, 1, 2}, {3, 4, 5}}),
                             camera)),
        cell(0, 0),
        separation(cell, surfaces.at(0), surfaces.at(1)),
        boundary(boundary_of_union(std::span(&cell.whole(), 1), counts)) {}

  template <class Depth>
  static MeshPoint at(double x, double y, const Depth& depth) {
    return {x, y, depth(x, y)};
  }
  [[nodiscard]] double least() const { return separation.least(boundary); }

  TierCounts counts;
  std::vector<SurfaceRegion> surfaces;
  ImageCell cell;
  Separation separation;
  Boundary boundary;
};

TEST(Separation, OfParallelPlanesIsTheirDistance) {
  const Planes planes(
      plain_camera(1, 1), [](double x, double y) { return 2 + x + y / 2; },
      [](double x, double y) { return 2.375 + x + y / 2; });
  EXPECT_TRUE(planes.separation.is_constantly(0.375));
  EXPECT_FALSE(planes.separation.is_constantly(std::nextafter(0.375, 1)));
  EXPECT_EQ(planes.least(), 0.375);
  EXPECT_TRUE(planes.separation.is_at_most(planes.boundary, 0.375));
  EXPECT_FALSE(planes.separation.is_below(planes.boundary, 0.375));
  EXPECT_TRUE(planes.separation.is_below(planes.boundary, std::nextafter(0.375, 1)));
}

TEST(Separation, InOnePlaneIsNothing) {
  const auto depth = [](double x, double y) { return 2 + x / 4 - y / 2; };
  const Planes planes(plain_camera(1, 1), depth, depth);
  EXPECT_EQ(planes.least(), 0);
  EXPECT_TRUE(planes.separation.is_constantly(0.0));
  EXPECT_TRUE(planes.separation.is_at_most(planes.boundary, 0.0));
  EXPECT_FALSE(planes.separation.is_below(planes.boundary, 0.0));
  EXPECT_TRUE(planes.separation.is_below(planes.boundary, 5e-324));
  EXPECT_FALSE(planes.separation.is_at_most(planes.boundary, -5e-324));
  EXPECT_FALSE(planes.separation.is_at_most({}, 1.0));
  EXPECT_FALSE(planes.separation.is_below({}, 1.0));
}

/// 1 + (x + y)/4 more: least, 1, in the corner (0, 0) of the pixel.
TEST(Separation, OfSlantedPlanesIsLeastInACorner) {
  const Planes planes(
      plain_camera(1, 1), [](double x, double) { return 2 - x / 8; },
      [](double x, double y) { return 3 + x / 8 + y / 4; });
  EXPECT_FALSE(planes.separation.is_constantly(1.0));
  EXPECT_EQ(planes.least(), 1);
  EXPECT_TRUE(planes.separation.is_at_most(planes.boundary, 1.0));
  EXPECT_FALSE(planes.separation.is_below(planes.boundary, 1.0));
  // Rounded once from the exact number where that is no binary64 number: a third less in front.
  const Planes thirds(
      plain_camera(1, 1), [](double x, double y) { return 3 - x - y; },
      [](double x, double y) { return 6 - x - y / 2; });
  EXPECT_EQ(thirds.least(), 3);
}

/// Seen in perspective D is a quotient; rounded once where the least value is no binary64 number.
/// On the rays (u, v, 1): 4/(4 − u) in front, 2/(1 + u) behind.
TEST(Separation, InPerspectiveIsThatOfQuotients) {
  Camera camera = checks::camera_of(1, 1, 1);
  camera.projection.cx = camera.projection.cy = 0;
  // z·(1 − u/4) = 1 with u = x/z is the plane z = 1 + x/4, z·(1 + u) = 2 the plane z = 2 − x.
  const Scene scene = scene_of({{-0.5, -4, 0.875},
                                {3, -4, 1.75},
                                {-0.5, 8, 0.875},
                                {-0.5, -8, 2.5},
                                {1.5, -8, 0.5},
                                {-0.5, 16, 2.5}},
                               {{0, 1, 2}, {3, 4, 5}});
  const auto surfaces = surfaces_of(scene, camera);
  ASSERT_EQ(surfaces.size(), 2U);
  ImageCell cell(0, 0);
  const Separation separation(cell, surfaces[0], surfaces[1]);
  TierCounts counts;
  // The strip of the pixel with u ≤ 1/2, in which the second lies behind the first:
  // 2/(1 + u) − 4/(4 − u) falls from 1 to 4/3 − 8/7 = 4/21.
  const auto half = cell.clip(cell.whole(), LinearForm({-2.0, 0.0, 1.0}), counts);
  ASSERT_TRUE(half);
  const Boundary boundary = boundary_of_union(std::span(&*half, 1), counts);
  EXPECT_EQ(separation.least(boundary), 4.0 / 21);
  EXPECT_FALSE(separation.is_at_most(boundary, 4.0 / 21 - 0x1p-50));
  EXPECT_TRUE(separation.is_below(boundary, 4.0 / 21 + 0x1p-50));
}

}  // namespace
}  // namespace fathom
