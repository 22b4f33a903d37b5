#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fathom/area/coverage.h"
#include "fathom/render.h"
#include "fathom/rendering/map_background.h"
#include "fathom/triangle/projected_triangle.h"
#include "tests/effort.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/sample_patterns.h"

namespace fathom {
namespace {

using namespace triangle;
using checks::all_patterns;
using checks::Kind;

Samples<float> shares(const Scene& scene, const Camera& camera, const std::string& pattern,
                      Engine engine, Cull cull = Cull::none) {
  const RenderOptions options{.engine = engine, .cull = cull};
  DepthMap map = rendering::make_background(camera, options);
  add_sampled_coverage(map, scene, camera, sample_pattern(pattern), options);
  return *map.values<float>("Asampled");
}

/// The specification, sections 4 and 5, at any point: exact numbers, no filter, no boxes.
bool is_covered(const std::vector<ProjectedTriangle>& triangles, const Camera& camera, Cull cull,
                double u, double v) {
  for (const ProjectedTriangle& t : triangles) {
    if (t.orientation == Sign::zero || !is_kept(t, cull)) continue;
    bool covers = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Sign sign = t.edges[i].at(u, v).sign();
      covers = covers && (sign == Sign::positive || (sign == Sign::zero && t.left_or_top[i]));
    }
    if (!covers) continue;
    const Ratio D = depth_at(t, {u, v});
    if (D.sign() != Sign::positive || D < Ratio(Dyadic(camera.near))) continue;
    if (std::isinf(camera.far) || !(Ratio(Dyadic(camera.far)) < D)) return true;
  }
  return false;
}

TEST(SampledCoverage, IsTheShareOfSamplesThatCount) {
  std::uint64_t partial = 0;
  for (int i = 0; i < 300 / checks::effort; ++i) {
    const Kind kind = i % 3 == 0 ? Kind::neighbours : i % 29 == 1 ? Kind::huge : Kind::few_bits;
    const checks::Case c = checks::CaseMaker(5000 + static_cast<std::uint64_t>(i), kind).make();
    const std::string& name = all_patterns[static_cast<std::size_t>(i) % all_patterns.size()];
    const Cull cull = i % 7 == 0 ? Cull::back : Cull::none;
    const SamplePattern pattern = sample_pattern(name);
    std::vector<ProjectedTriangle> triangles;
    TierCounts counts;
    for (std::uint32_t t = 0; t < c.scene.meshes[0].triangles.size(); ++t) {
      triangles.push_back(
          project(world_corners(c.scene.objects[0], c.scene.meshes[0], t), t, c.camera, counts));
    }
    const Samples<float> fast = shares(c.scene, c.camera, name, Engine::fast, cull);
    const Samples<float> exact = shares(c.scene, c.camera, name, Engine::reference, cull);
    for (std::uint32_t row = 0; row < c.camera.height; ++row) {
      for (std::uint32_t column = 0; column < c.camera.width; ++column) {
        std::size_t covered = 0;
        for (std::size_t k = 0; k < pattern.count(); ++k) {
          const auto [u, v] = pattern.at(k, column, row);
          covered += is_covered(triangles, c.camera, cull, column + 0.5 + u, row + 0.5 + v) ? 1 : 0;
        }
        const float share = static_cast<float>(covered) / static_cast<float>(pattern.count());
        const std::size_t pixel = row * c.camera.width + column;
        ASSERT_EQ(exact[pixel], share) << name << ", case " << i << ", pixel " << pixel;
        ASSERT_EQ(fast[pixel], share) << name << ", case " << i << ", pixel " << pixel;
        partial += share > 0 && share < 1 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(partial, 500U / checks::effort);
}

/// An edge that cuts pixels of column 2 at u = 2.375: samples left of it, and on it, as it is a
/// right edge, not.
TEST(SampledCoverage, OfAnUprightEdge) {
  Camera camera = checks::camera_of(4, 4, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0;
  const Scene scene = checks::scene_of({{-9, -9, 1}, {2.375, -9, 1}, {2.375, 99, 1}, {-9, 99, 1}},
                                       {{0, 1, 2}, {0, 2, 3}});
  const auto share = [&](const std::string& pattern) {
    return shares(scene, camera, pattern, Engine::fast)[1 * 4 + 2];
  };
  EXPECT_EQ(share("1"), 0);
  EXPECT_EQ(share("2"), 0.5F);
  EXPECT_EQ(share("4"), 0.25F);       // at −6/16 and not at −2/16, which lies on the edge
  EXPECT_EQ(share("8"), 3 / 8.0F);    // −3, −5, −7 sixteenths
  EXPECT_EQ(share("16"), 6 / 16.0F);  // −3, −5, −4, −6, −8, −7
  EXPECT_EQ(share("rotated-grid"), 0.25F);
  EXPECT_EQ(share("regular:2"), 0.5F);   // −1/4
  EXPECT_EQ(share("regular:4"), 0.25F);  // −3/8, and −1/8 on the edge
}

}  // namespace
}  // namespace fathom
