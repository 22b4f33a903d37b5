#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "fathom/rays/cast.h"
#include "tests/adversaries.h"
#include "tests/inputs/spheres.h"
#include "tests/rays/rational_rays.h"
#include "tests/rays/voxel_solids.h"

namespace fathom::rays {
namespace {

constexpr CastOptions whole_line{.segment = {.t_min = -std::numeric_limits<double>::infinity()}};

/// A closed sphere: all points of the last ring are one.
Scene closed_sphere(std::uint32_t rings, bool in_binary32) {
  Scene scene;
  scene.meshes.push_back(checks::sphere(rings));
  scene.objects.push_back({.name = "sphere"});
  auto& vertices = scene.meshes[0].vertices;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    MeshPoint& p = vertices[i];
    if (i + 2 * std::size_t{rings} >= vertices.size()) p = {0, -1, 0};
    if (in_binary32)
      p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
  }
  return scene;
}

/// Rays from places within a scene at each of its vertices and at the middles of edges.
std::vector<Ray> rays_at_vertices(const Scene& scene) {
  const Mesh& mesh = scene.meshes[0];
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-0.4, 0.4);
  std::vector<Ray> rays;
  for (const CornerIndices& t : mesh.triangles) {
    const MeshPoint &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]];
    const double x = place(random), y = place(random), z = place(random);
    rays.push_back({{x, y, z}, {a.x - x, a.y - y, a.z - z}});
    rays.push_back({{0, 0, 0}, {a.x, a.y, a.z}});
    rays.push_back({{0, 0, 0}, {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.z + b.z) / 2}});
  }
  return rays;
}

class ClosedSphere : public ::testing::TestWithParam<bool> {};

// A ray from within leaves a sphere once, wherever it is aimed at.
TEST_P(ClosedSphere, LosesNoRay) {
  const Scene scene = closed_sphere(60, GetParam());
  const RayScene prepared(scene);
  const std::vector<Ray> rays = rays_at_vertices(scene);
  const auto counts = count_hits(prepared, rays);
  EXPECT_EQ(std::ranges::count(counts, 1U), static_cast<std::ptrdiff_t>(rays.size()));
  const auto is_hit = occluded(prepared, rays);
  EXPECT_EQ(std::ranges::count(is_hit, true), static_cast<std::ptrdiff_t>(rays.size()));
  // Front faces point outwards.
  const auto culled = count_hits(prepared, rays, {.cull = Cull::back});
  EXPECT_EQ(std::ranges::count(culled, 0U), static_cast<std::ptrdiff_t>(rays.size()));
}

TEST_P(ClosedSphere, IsMetTwiceByALine) {
  // So many triangles that threads share the making of the tree.
  const Scene scene = closed_sphere(80, GetParam());
  const RayScene prepared(scene);
  const std::vector<Ray> rays = rays_at_vertices(scene);
  const auto counts = count_hits(prepared, rays, whole_line);
  EXPECT_EQ(std::ranges::count(counts, 2U), static_cast<std::ptrdiff_t>(rays.size()));
}

INSTANTIATE_TEST_SUITE_P(Numbers, ClosedSphere, ::testing::Bool(),
                         [](const auto& in_binary32) -> std::string {
                           return in_binary32.param ? "Binary32" : "Binary64";
                         });

TEST(Cast, AnswersTheSameWithAnyNumberOfThreads) {
  const Scene scene = closed_sphere(80, false);
  const std::vector<Ray> rays = rays_at_vertices(scene);
  const RayScene by_one(scene, 1), by_many(scene, 7);
  EXPECT_EQ(cast(by_one, rays, {.threads = 1}), cast(by_many, rays, {.threads = 7}));
}

/// All hits of a ray, without the numbers of triangles.
std::vector<double> values_of(const RayHitLists& lists) {
  std::vector<double> values;
  for (const RayHit& hit : lists.hits) values.push_back(hit.t);
  return values;
}

TEST(RayLawAdversaries, LinesMeetClosedSurfacesAnEvenNumberOfTimes) {
  checks::for_each_adversary(300, [](std::uint64_t seed) {
    const Scene scene = test::voxel_solid(seed);
    const RayScene prepared(scene);
    const std::vector<Ray> rays = test::rays_at_voxels(seed, 50);
    auto front = whole_line, back = whole_line;
    front.cull = Cull::back;
    back.cull = Cull::front;
    EXPECT_EQ(count_hits(prepared, rays, front), count_hits(prepared, rays, back));
  });
}

// At an edge that a ray only touches it enters and leaves at the same t.
TEST(RayLawAdversaries, LinesEnterSolidsWhereTheyFirstMeetThem) {
  checks::for_each_adversary(300, [](std::uint64_t seed) {
    const Scene scene = test::voxel_solid(seed);
    const RayScene prepared(scene);
    const std::vector<Ray> rays = test::rays_at_voxels(seed, 50);
    auto entries = whole_line;
    entries.cull = Cull::back;
    const auto nearest = cast(prepared, rays, whole_line), entry = cast(prepared, rays, entries);
    for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(nearest[i].t, entry[i].t);
  });
}

TEST(RayLawAdversaries, RoundedValuesStayWhereTrianglesAreInAnotherOrder) {
  checks::for_each_adversary(150, [](std::uint64_t seed) {
    Scene scene = test::voxel_solid(seed);
    const std::vector<Ray> rays = test::rays_at_voxels(seed, 50);
    const auto expected = values_of(all_hits(RayScene(scene), rays));
    std::mt19937_64 random(seed);
    auto triangles = std::vector<CornerIndices>(scene.meshes[0].triangles.begin(),
                                                scene.meshes[0].triangles.end());
    std::ranges::shuffle(triangles, random);
    for (CornerIndices& t : triangles) std::rotate(t.begin(), t.begin() + seed % 3, t.end());
    scene.meshes[0].triangles = std::move(triangles);
    EXPECT_EQ(values_of(all_hits(RayScene(scene), rays)), expected);
  });
}

TEST(RayLawAdversaries, PointsAreInsideAsByRationals) {
  checks::for_each_adversary(60, [](std::uint64_t seed) {
    const Scene scene = test::voxel_solid(seed);
    const RayScene prepared(scene);
    const auto triangles = test::rational_triangles(scene);
    std::vector<std::array<double, 3>> points;
    for (const Ray& ray : test::rays_at_voxels(seed, 40)) points.push_back(ray.origin);
    const auto numbers = winding_numbers(prepared, points);
    const auto inside = contains(prepared, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const oracle::Vector point = oracle::exact_vector(points[i]);
      EXPECT_EQ(numbers[i], oracle::winding_number(point, {1, 0, 0}, triangles));
      EXPECT_EQ(inside[i], numbers[i] != 0);
      // Of a closed surface the direction does not matter.
      EXPECT_EQ(numbers[i], oracle::winding_number(point, {-2, 3, 1}, triangles));
    }
  });
}

}  // namespace
}  // namespace fathom::rays
