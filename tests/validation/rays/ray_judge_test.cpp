#include "validation/rays/ray_judge.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/rays/cast.h"
#include "validation/rays/ray_cases.h"
#include "validation/rays/ray_engines.h"
#include "validation/scenes/shapes.h"

namespace fathom::validation {
namespace {

/// Two squares, at z = 0 (triangles 0 and 1, which share the diagonal x = y) and, behind it along
/// −z, at z = −1 (triangles 2 and 3).
attribution::WorldMesh two_squares() {
  attribution::WorldMesh mesh;
  mesh.points = {{0, 0, 0},  {1, 0, 0},  {1, 1, 0},  {0, 1, 0},
                 {0, 0, -1}, {1, 0, -1}, {1, 1, -1}, {0, 1, -1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  return mesh;
}

Ray down(double x, double y) {
  return {{x, y, 1}, {0, 0, -1}};
}

/// The verdict on one answer about the squares.
RayVerdict verdict_on(const Ray& ray, const RayHit& answer) {
  const RayCase given{"squares", "one", two_squares(), {ray}};
  return RayJudge(given).judge({{answer}, {2}}).verdicts.at(0);
}

TEST(RayJudge, NamesEachFault) {
  const Ray ray = down(0.75, 0.25), beside = down(2, 2);
  EXPECT_EQ(verdict_on(ray, {0, 1}), RayVerdict::right);
  EXPECT_EQ(verdict_on(beside, {}), RayVerdict::right);
  EXPECT_EQ(verdict_on(ray, {}), RayVerdict::lost);
  EXPECT_EQ(verdict_on(ray, {2, 2}), RayVerdict::behind);
  EXPECT_EQ(verdict_on(ray, {1, 1}), RayVerdict::beside);
  EXPECT_EQ(verdict_on(ray, {99, 1}), RayVerdict::beside);
  EXPECT_EQ(verdict_on(beside, {0, 1}), RayVerdict::invented);
}

TEST(RayJudge, TakesBothTrianglesOfAnEdge) {
  const Ray ray = down(0.5, 0.5);
  EXPECT_NE(verdict_on(ray, {0, 1}), verdict_on(ray, {1, 1}));
  EXPECT_FALSE(is_fault(verdict_on(ray, {0, 1})));
  EXPECT_FALSE(is_fault(verdict_on(ray, {1, 1})));
  EXPECT_EQ(verdict_on(ray, {2, 2}), RayVerdict::behind);
  EXPECT_EQ(verdict_on(ray, {}), RayVerdict::lost);
}

TEST(RayJudge, TakesNoHitAndAnyHitAtTheBoundary) {
  for (const Ray& ray : {down(0.5, 0), down(1, 0.5), down(0, 0.5), down(0, 0), down(1, 1)}) {
    EXPECT_FALSE(is_fault(verdict_on(ray, {})));
    EXPECT_FALSE(is_fault(verdict_on(ray, {0, 1})) && is_fault(verdict_on(ray, {1, 1})));
  }
}

TEST(RayJudge, CountsOnlyRaysThatTouchNoEdge) {
  const RayCase given{"squares",
                      "three",
                      two_squares(),
                      {down(0.75, 0.25), down(0.25, 0.75), down(0.5, 0.5), down(0.5, 0)}};
  const EngineAnswers answers{{{0, 1}, {1, 1}, {0, 1}, {0, 1}}, {1, 3, 7, 7}};
  const JudgedRays judged = RayJudge(given).judge(answers);
  EXPECT_EQ(judged.counts_judged, 2U);
  EXPECT_EQ(judged.counts_too_low, 1U);
  EXPECT_EQ(judged.counts_too_high, 1U);
  EXPECT_EQ(judged.faults(), 0U);
}

TEST(RayJudge, MeasuresTInStepsOfBinary32) {
  const RayCase given{"squares", "one", two_squares(), {down(0.75, 0.25)}};
  const JudgedRays judged = RayJudge(given).judge({{{0, 1 + 0x3p-23}}, {2}});
  EXPECT_EQ(judged.greatest_error_of_t, 3);
}

/// CGAL's exact kernel shares nothing with Fathom's arithmetic.
TEST(RayEngines, CgalAgreesWithTheTruth) {
  std::vector<RayCase> cases = made_ray_cases(400);
  for (RayCase& one : ray_cases("squares", two_squares(), 400)) cases.push_back(std::move(one));
  for (const RayCase& one : cases) {
    const EngineAnswers answers = trace(RayEngine::cgal, one.mesh, one.rays);
    const JudgedRays judged = RayJudge(one).judge(answers);
    EXPECT_EQ(judged.faults(), 0U) << one.scene << ", " << one.rays_name;
    EXPECT_EQ(judged.counts_too_low + judged.counts_too_high, 0U) << one.scene;
    EXPECT_LT(judged.greatest_error_of_t, 0.01);
  }
}

TEST(RayCases, AreMadeOfBinary32Numbers) {
  attribution::WorldMesh mesh = two_squares();
  mesh.points[0] = {0.1, 0.2, 0.3};
  for (const RayCase& one : ray_cases("squares", mesh, 50)) {
    EXPECT_EQ(one.rays.size(), 50U);
    EXPECT_EQ(one.mesh.points[0][0], static_cast<double>(0.1F));
    for (const Ray& ray : one.rays) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(ray.origin[k], static_cast<double>(static_cast<float>(ray.origin[k])));
        EXPECT_EQ(ray.direction[k], static_cast<double>(static_cast<float>(ray.direction[k])));
      }
      EXPECT_NE(ray.direction, (std::array<double, 3>{}));
    }
  }
  EXPECT_THROW(ray_cases("empty", {}, 1), InputError);
  mesh.points[0][0] = 1e300;
  EXPECT_THROW(ray_cases("far", mesh, 1), InputError);
}

/// Every ray that comes from outside a closed surface meets it an even number of times, also
/// through edges and corners.
TEST(RayCases, VoxelsAreClosed) {
  const RayCase voxels = made_ray_cases(500).at(1);
  Mesh mesh;
  for (const auto& [x, y, z] : voxels.mesh.points) mesh.vertices.push_back({x, y, z});
  mesh.triangles = voxels.mesh.triangles;
  const Scene scene = bench::as_scene({mesh}, "voxels");
  std::size_t met = 0;
  for (const std::uint32_t count : count_hits(RayScene(scene), voxels.rays)) {
    EXPECT_EQ(count % 2, 0U);
    met += count > 0 ? 1 : 0;
  }
  EXPECT_GT(met, 250U);
  const JudgedRays judged =
      RayJudge(voxels).judge(trace(RayEngine::cgal, voxels.mesh, voxels.rays));
  EXPECT_LT(judged.counts_judged, 400U);  // many rays pass through edges
}

}  // namespace
}  // namespace fathom::validation
