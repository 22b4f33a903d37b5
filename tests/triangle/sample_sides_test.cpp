#include <gtest/gtest.h>

#include <random>

#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/triangle_boxes.h"
#include "tests/effort.h"
#include "tests/inputs/random_scenes.h"

namespace fathom {
namespace {

using namespace triangle;
using checks::CaseMaker;
using checks::effort;
using checks::Kind;

SampleSides::Sides shared_sides(const SampleSides& sides, const Mesh& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return sides.of(mesh.vertices[a]) & sides.of(mesh.vertices[b]) & sides.of(mesh.vertices[c]);
}

/// Also behind the camera, and where corners lie on both sides of it.
TEST(SampleSides, TrianglesThatShareASideDoNotCoverTheSample) {
  int missed = 0, left_out = 0, covered = 0;
  std::mt19937 random(3);
  for (const Kind kind : {Kind::few_bits, Kind::neighbours, Kind::huge, Kind::tiny}) {
    CaseMaker maker(11 + static_cast<std::uint64_t>(kind), kind);
    for (int i = 0; i < 1000 / effort; ++i) {
      const checks::Case c = maker.make();
      const Object& object = c.scene.objects[0];
      const Mesh& mesh = c.scene.meshes[0];
      const ImagePoint s{random() % c.camera.width + 0.5, random() % c.camera.height + 0.5};
      const SampleSides sides(object, c.camera, s);
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        TierCounts counts;
        const ProjectedTriangle exact =
            project(world_corners(object, mesh, t), t, c.camera, counts);
        const bool covers_it = exact.orientation != Sign::zero && covers(exact, s, counts);
        const bool is_left_out = shared_sides(sides, mesh, t) != 0;
        EXPECT_FALSE(covers_it && is_left_out);
        covered += covers_it;
        missed += !covers_it;
        left_out += is_left_out;
      }
    }
  }
  EXPECT_GT(covered, 100 / effort);
  EXPECT_GT(left_out, missed / 3);
}

/// A corner exactly on the sample's column lies on neither side of it.
TEST(SampleSides, OfPointsInFrontAndBehind) {
  Camera camera;
  camera.width = camera.height = 4;
  camera.projection.fx = camera.projection.fy = 2;
  camera.projection.cx = camera.projection.cy = 2;
  const SampleSides sides(Object(), camera, {2.5, 1.5});
  // Images at (2, 2), (3, 1) and (2.5, 1.5); the last one is the first seen from behind.
  const auto a = sides.of({0, 0, 1}), b = sides.of({0.5, -0.5, 1}), c = sides.of({0.25, -0.25, 1});
  EXPECT_NE(a, 0);
  EXPECT_NE(b, 0);
  EXPECT_EQ(a & b, 0);
  EXPECT_EQ(c, 0);
  EXPECT_EQ(sides.of({0, 0, -1}), b);
}

}  // namespace
}  // namespace fathom
