// probe() against every triangle looked at exactly, one by one.
#include "fathom/reference/probe.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/sampling.h"
#include "tests/effort.h"
#include "tests/inputs/random_scenes.h"

namespace fathom {
namespace {

using namespace triangle;
using testing::CaseMaker;
using testing::effort;
using testing::Kind;

struct Covering {
  std::uint32_t number;
  Ratio depth;
};

/// In the order of their numbers.
std::vector<Covering> by_brute_force(const Scene& scene, const Camera& camera, std::uint32_t x,
                                     std::uint32_t y) {
  const ImagePoint s = centre_of_pixel(x, y);
  std::vector<Covering> found;
  std::uint32_t number = 0;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i, ++number) {
      TierCounts counts;
      const ProjectedTriangle t = project(world_corners(object, mesh, i), number, camera, counts);
      if (t.orientation == Sign::zero || !covers(t, s, counts)) continue;
      found.push_back({number, depth_at(t, s)});
    }
  }
  return found;
}

void check(const Scene& scene, const Camera& camera, std::uint32_t x, std::uint32_t y,
           int& covered) {
  std::vector<CoveringTriangle> found = probe(scene, camera, x, y);
  std::ranges::sort(found, {}, &CoveringTriangle::number);
  const std::vector<Covering> expected = by_brute_force(scene, camera, x, y);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].number, expected[i].number);
    EXPECT_TRUE(found[i].depth == expected[i].depth);
  }
  covered += static_cast<int>(found.size());
}

TEST(Probe, FindsWhatEveryTriangleLookedAtExactlyGives) {
  int covered = 0;
  for (const Kind kind : {Kind::few_bits, Kind::neighbours, Kind::huge, Kind::tiny}) {
    CaseMaker maker(29 + static_cast<std::uint64_t>(kind), kind);
    for (int i = 0; i < 200 / effort; ++i) {
      testing::Case c = maker.make();
      // The same mesh once more, elsewhere: numbers go on from one object to the next.
      Object second = c.scene.objects[0];
      second.placed_as_is = false;
      second.world_from_mesh.rows[0] = {-1.0, 0.0, 0.0, 0.25};
      c.scene.objects.push_back(second);
      for (std::uint32_t y = 0; y < c.camera.height; ++y) {
        for (std::uint32_t x = 0; x < c.camera.width; ++x) check(c.scene, c.camera, x, y, covered);
      }
    }
  }
  EXPECT_GT(covered, 1000 / effort);
}

/// What is beyond far covers samples too, without counting; what is behind the camera does not.
TEST(Probe, ShowsTrianglesThatDoNotCount) {
  Scene scene;
  scene.meshes.emplace_back();
  scene.meshes[0].vertices = {{-1, -1, -2}, {1, -1, -2}, {0, 2, -2},
                              {-1, -1, 2},  {1, -1, 2},  {0, 2, 2}};
  scene.meshes[0].triangles = {{0, 1, 2}, {3, 4, 5}};
  scene.objects.emplace_back();
  Camera camera;
  camera.width = camera.height = 3;
  camera.projection.fx = camera.projection.fy = 3;
  camera.projection.cx = camera.projection.cy = 1.5;
  camera.far = 1;
  const auto found = probe(scene, camera, 1, 1);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].number, 1U);
  EXPECT_FALSE(found[0].counts);
}

}  // namespace
}  // namespace fathom
