#include "fathom/scene/bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "fathom/numeric/rounding.h"
#include "tests/inputs/scene_of_points.h"
#include "tests/special_values.h"

namespace fathom {
namespace {

using Vector3 = std::array<double, 3>;
TEST(WorldBounds, OfMeshesAsTheyAre) {
  Scene scene = checks::scene_of_points({{1, 2, 3}, {-1, 5, 2}});
  // A vertex that no triangle uses does not count.
  scene.meshes[0].vertices.push_back({100, 100, 100});
  const auto bounds = world_bounds(scene);
  ASSERT_TRUE(bounds);
  EXPECT_EQ(bounds->lower, (Vector3{-1, 2, 2}));
  EXPECT_EQ(bounds->upper, (Vector3{1, 5, 3}));
  EXPECT_EQ(world_bounds(Scene()), std::nullopt);
}

TEST(WorldBounds, OfPlacedMeshesAreTheExactOnesRoundedOutwards) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int round = 0; round < 300; ++round) {
    const double scale = std::pow(10.0, 40 * any(random));
    std::vector<MeshPoint> vertices;
    for (int i = 0; i < 30; ++i)
      vertices.push_back({scale * any(random), scale * std::round(2 * any(random)), any(random)});
    // Neighbours that differ by ulps: floating point takes the wrong one for the extreme.
    if (round % 2 == 0)
      for (MeshPoint& p : vertices)
        p = {vertices[0].x * (1 + 0x1p-52 * std::round(3 * any(random))), vertices[0].y,
             vertices[0].z * (1 + 0x1p-52 * std::round(3 * any(random)))};
    Scene scene = checks::scene_of_points(vertices);
    Object& object = scene.objects[0];
    object.placed_as_is = false;
    for (auto& row : object.world_from_mesh.rows)
      for (Dyadic& x : row) x = Dyadic(any(random)) * Dyadic(any(random));
    // Near the origin of the world, where what floating point loses is all that is left.
    if (round % 2 == 0)
      for (auto& row : object.world_from_mesh.rows) {
        const MeshPoint& p = vertices[0];
        row[3] = Dyadic(-round_to_binary64(Ratio(row[0] * p.x + row[1] * p.y + row[2] * p.z)));
      }
    if (round % 3 == 0) object.world_from_mesh.rows[1] = {0.0, 1e-310, 0.0, 0x1p-1074};
    if (round % 3 == 1) object.world_from_mesh.rows[2][0] = Dyadic(1e300) * Dyadic(1e300);
    Vector3 lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
    for (const MeshPoint& p : vertices) {
      const WorldPoint q = object.world_from_mesh(p);
      const Dyadic* X[3] = {&q.x, &q.y, &q.z};
      for (int k = 0; k < 3; ++k) {
        lower[k] = std::min(lower[k], enclose(*X[k]).lower);
        upper[k] = std::max(upper[k], enclose(*X[k]).upper);
      }
    }
    const auto bounds = world_bounds(scene);
    ASSERT_TRUE(bounds);
    ASSERT_EQ(bounds->lower, lower);
    ASSERT_EQ(bounds->upper, upper);
  }
}
}  // namespace
}  // namespace fathom
