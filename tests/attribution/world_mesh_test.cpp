#include <gtest/gtest.h>

#include "fathom/attribution/model/renderer_input.h"

namespace fathom::attribution {
namespace {

using Point = std::array<double, 3>;

TEST(WorldMesh, ObjectsFollowEachOtherInTheWorld) {
  Scene scene;
  scene.meshes.push_back(
      {.vertices = {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}}, .triangles = {{0, 1, 2}}});
  scene.objects.push_back({.mesh = 0});
  Object turned{.mesh = 0, .placed_as_is = false};
  turned.world_from_mesh.rows = {
      {{0.0, 1.0, 0.0, 10.0}, {0.0, 0.0, 1.0, 0.5}, {2.0, 0.0, 0.0, 0.0}}};
  scene.objects.push_back(turned);

  const WorldMesh world = world_mesh(scene);
  ASSERT_EQ(world.points.size(), 6U);
  EXPECT_EQ(world.points[0], (Point{1, 2, 3}));
  EXPECT_EQ(world.points[3], (Point{12, 3.5, 2}));
  EXPECT_EQ(world.points[5], (Point{18, 10.5, 14}));
  ASSERT_EQ(world.triangles.size(), 2U);
  EXPECT_EQ(world.triangles[0], (CornerIndices{0, 1, 2}));
  EXPECT_EQ(world.triangles[1], (CornerIndices{3, 4, 5}));
}

TEST(WorldMesh, PlacedPointsAreRoundedOnce) {
  Scene scene;
  scene.meshes.push_back({.vertices = {{0x1p-60, 1, 0}}, .triangles = {}});
  Object sheared{.mesh = 0, .placed_as_is = false};
  sheared.world_from_mesh.rows[0] = {{1.0, 1.0, 0.0, -1.0}};  // x + y − 1
  scene.objects.push_back(sheared);
  EXPECT_EQ(world_mesh(scene).points[0][0], 0x1p-60);
}

TEST(WorldMesh, ItsBoxContainsPointsOfNoTriangleToo) {
  EXPECT_EQ(box_of({}), std::nullopt);
  const WorldMesh mesh{.points = {{1, -2, 3}, {-4, 5, 0}, {2, 2, 7}}, .triangles = {}};
  EXPECT_EQ(box_of(mesh), (WorldBounds{{-4, -2, 0}, {2, 5, 7}}));
}

}  // namespace
}  // namespace fathom::attribution
