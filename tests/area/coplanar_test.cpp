// Pairs of surfaces that coincide or nearly do, known on paper and against differences of depth on
// a fine grid.
#include "fathom/area/coplanar.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/inputs/scene_building.h"

namespace fathom {
namespace {

using checks::camera_of;
using checks::scene_of;

Camera orthographic(std::uint32_t width, std::uint32_t height) {
  Camera camera = camera_of(width, height, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0;
  return camera;
}

/// Two right triangles with legs of 4 pixels, the second `behind` deeper and with another slope.
Scene two_triangles(double behind, double slope = 0) {
  return scene_of({{0, 0, 1},
                   {4, 0, 1},
                   {0, 4, 1},  //
                   {0, 0, 1 + behind},
                   {4, 0, 1 + behind + 4 * slope},
                   {0, 4, 1 + behind}},
                  {{0, 1, 2}, {3, 4, 5}});
}

TEST(Coplanar, ParallelTriangles) {
  const Scene scene = two_triangles(0.25);
  EXPECT_TRUE(coplanar_pairs(scene, orthographic(4, 4), std::nextafter(0.25, 0), {}).empty());
  const auto pairs = coplanar_pairs(scene, orthographic(4, 4), 0.25, {});
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].visible, 0U);
  EXPECT_EQ(pairs[0].behind, 1U);
  EXPECT_EQ(pairs[0].separation, 0.25);
  EXPECT_EQ(pairs[0].pixels, 10U);  // 4 + 3 + 2 + 1 pixels meet the inside
  EXPECT_EQ(pairs[0].box.last_column, 3U);
}

TEST(Coplanar, EqualDepthsBelongToTheLowerNumber) {
  Scene scene = two_triangles(0);
  EXPECT_TRUE(coplanar_pairs(scene, orthographic(4, 4), 0, {}).empty());  // they share corners
  scene.meshes[0].vertices[3] = {-1, -1, 1};
  scene.meshes[0].vertices[4] = {4.5, 0, 1};
  scene.meshes[0].vertices[5] = {0, 3.5, 1};
  const auto pairs = coplanar_pairs(scene, orthographic(4, 4), 0, {});
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].visible, 0U);
  EXPECT_EQ(pairs[0].separation, 0.0);
}

// D − 1 = 0.5 + u/4: within 1 the columns u < 2 are close.
TEST(Coplanar, OnlyPixelsThatAreCloseCount) {
  const auto pairs = coplanar_pairs(two_triangles(0.5, 0.25), orthographic(4, 4), 1, {});
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].separation, 0.5);
  EXPECT_EQ(pairs[0].pixels, 7U);  // 4 + 3 in the columns 0 and 1
  EXPECT_EQ(pairs[0].box.last_column, 1U);
}

TEST(Coplanar, AThirdTriangleHidesThePair) {
  Scene scene = two_triangles(0.25);
  auto& mesh = scene.meshes[0];
  for (const MeshPoint& p : {MeshPoint{-1, -1, 0.5}, {9, -1, 0.5}, {-1, 9, 0.5}}) {
    mesh.vertices.push_back(p);
  }
  mesh.triangles.push_back({6, 7, 8});
  const auto pairs = coplanar_pairs(scene, orthographic(4, 4), 0.25, {});
  EXPECT_TRUE(pairs.empty());
  EXPECT_EQ(coplanar_pairs(scene, orthographic(4, 4), 1, {}).size(), 2U);
}

/// Depth of the plane through a triangle at an image point; perspective, in binary64.
double depth_at(const std::array<MeshPoint, 3>& t, const Camera& camera, double u, double v) {
  const auto& [a, b, c] = t;
  const double e[] = {b.x - a.x, b.y - a.y, b.z - a.z}, f[] = {c.x - a.x, c.y - a.y, c.z - a.z};
  const double n[] = {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2],
                      e[0] * f[1] - e[1] * f[0]};
  const double ray[] = {(u - camera.projection.cx) / camera.projection.fx,
                        (v - camera.projection.cy) / camera.projection.fy, 1};
  return (n[0] * a.x + n[1] * a.y + n[2] * a.z) / (n[0] * ray[0] + n[1] * ray[1] + n[2] * ray[2]);
}

// Under perspective the least difference lies between the corners, at an irrational place: the
// planes 1/D = 1/4 + u/16 and 1/D = 1/5 + u/40 over 0 ≤ u ≤ 4 are nearest to each other at an end,
// those with the slopes below in between.
TEST(Coplanar, TheLeastSeparationUnderPerspectiveIsFoundBetweenCorners) {
  const Camera camera = camera_of(16, 12, 16);
  const auto point = [&](double u, double v, double depth) {
    return MeshPoint{(u - camera.projection.cx) / camera.projection.fx * depth,
                     (v - camera.projection.cy) / camera.projection.fy * depth, depth};
  };
  const std::array<MeshPoint, 3> front{point(1, 1, 2), point(15, 1, 4), point(1, 11, 2)};
  const std::array<MeshPoint, 3> behind{point(1, 1, 2.75), point(15, 1, 4.5), point(1, 11, 2.5)};
  std::vector<MeshPoint> vertices(front.begin(), front.end());
  vertices.insert(vertices.end(), behind.begin(), behind.end());
  const Scene scene = scene_of(vertices, {{0, 1, 2}, {3, 4, 5}});
  double least = 1e9;
  constexpr int n = 700;
  for (int i = 0; i <= n; ++i) {
    for (int k = 0; i + k <= n; ++k) {
      const double u = 1 + 14.0 * i / n, v = 1 + 10.0 * k / n;
      least = std::min(least, depth_at(behind, camera, u, v) - depth_at(front, camera, u, v));
    }
  }
  const auto pairs = coplanar_pairs(scene, camera, 1, {});
  ASSERT_EQ(pairs.size(), 1U);
  // No point of the grid is below it, but for rounding; the grid's step bounds how far above it the
  // grid's least value is: the difference is smooth, and its least value at most a step away from
  // one of the grid on the rim, along which it is flat to the first order.
  EXPECT_LE(pairs[0].separation, least + 1e-13);
  EXPECT_GT(pairs[0].separation, least - 1e-4);
  const double found = pairs[0].separation;
  EXPECT_TRUE(coplanar_pairs(scene, camera, std::nextafter(found, 0), {}).empty());
  EXPECT_EQ(coplanar_pairs(scene, camera, std::nextafter(found, 9), {}).size(), 1U);
}

}  // namespace
}  // namespace fathom
