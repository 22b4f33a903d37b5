// Triangles with the same corners in the same order round are found, whatever corner comes first.
#include <gtest/gtest.h>

#include "fathom/area/coverage_image.h"
#include "tests/inputs/scene_building.h"

namespace fathom {
namespace {

using area::EqualTriangles;

TEST(EqualTriangles, HaveTheSameCornersInTheSameOrderRound) {
  Scene scene =
      checks::scene_of({{0, 0, 1}, {1, 0, 1}, {0, 1, 2}, {0, 0, 1}, {0, 1, 2.0000000000000004}},
                       {{0, 1, 2}, {1, 2, 3}, {2, 1, 0}, {0, 1, 4}, {2, 0, 1}, {1, 0, 2}});
  const TriangleSource triangles(scene);
  EqualTriangles equal(triangles);
  EXPECT_TRUE(equal.is_first(0));
  EXPECT_FALSE(equal.is_first(1));
  EXPECT_TRUE(equal.is_first(2));
  EXPECT_TRUE(equal.is_first(3));
  EXPECT_FALSE(equal.is_first(4));
  EXPECT_FALSE(equal.is_first(5));
}

// Placed so that they come to lie on each other, exactly or nearly.
TEST(EqualTriangles, AreComparedInTheWorld) {
  Scene scene = checks::scene_of({{0, 0, 1}, {1, 0, 1}, {0, 1, 2}}, {{0, 1, 2}});
  const auto place = [&](double scale, double x) {
    Mesh mesh = scene.meshes[0];
    for (MeshPoint& p : mesh.vertices) p = {(p.x - x) / scale, p.y / scale, p.z / scale};
    scene.meshes.push_back(mesh);
    Object object{.mesh = scene.meshes.size() - 1, .name = "placed"};
    object.placed_as_is = false;
    auto& rows = object.world_from_mesh.rows;
    for (std::size_t k = 0; k < 3; ++k) rows[k][k] = scale;
    rows[0][3] = x;
    scene.objects.push_back(object);
  };
  place(4, 0.5);
  place(4, 0x1p-70);  // x − 2⁻⁷⁰ is rounded: off by so much
  const TriangleSource triangles(scene);
  EqualTriangles equal(triangles);
  EXPECT_TRUE(equal.is_first(0));
  EXPECT_FALSE(equal.is_first(1));
  EXPECT_TRUE(equal.is_first(2));
}

// More than any first table has room for.
TEST(EqualTriangles, AreFoundAmongMany) {
  constexpr std::uint32_t count = 1000;
  Scene scene = checks::scene_of({{0, 0, 1}, {1, 0, 1}}, {});
  Mesh& mesh = scene.meshes[0];
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.vertices.push_back({i * 0.5, 1, 2});
    mesh.triangles.push_back({0, 1, i + 2});
  }
  for (std::uint32_t i = 0; i < count; ++i) mesh.triangles.push_back({i + 2, 0, 1});
  const TriangleSource triangles(scene);
  EqualTriangles equal(triangles);
  for (std::uint32_t i = 0; i < 2 * count; ++i) EXPECT_EQ(equal.is_first(i), i < count) << i;
}

}  // namespace
}  // namespace fathom
