// probe() against every triangle looked at exactly, one by one.
#include "fathom/reference/probe.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fathom/numeric/rounding.h"
#include "fathom/reference/reference.h"
#include "fathom/triangle/projected_triangle.h"
#include "tests/effort.h"
#include "tests/inputs/lens_scenes.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/tables_of_directions.h"

namespace fathom {
namespace {

using namespace triangle;
using checks::CaseMaker;
using checks::effort;
using checks::Kind;

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
      checks::Case c = maker.make();
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

/// The first triangle that counts is what the reference engine shows, with its values.
void expect_shown(const DepthMap& map, std::size_t pixel,
                  const std::vector<CoveringTriangle>& found) {
  const bool shows = !found.empty() && found[0].counts;
  ASSERT_EQ((*map.values<std::uint32_t>("id"))[pixel], shows ? found[0].number : no_surface);
  if (!shows) return;
  EXPECT_EQ((*map.values<float>("Z"))[pixel], found[0].stored_depth);
  EXPECT_EQ(round_to_binary32(found[0].depth), found[0].stored_depth);
  EXPECT_EQ((*map.values<float>("distance"))[pixel],
            found[0].stored_distance.value_or((*map.values<float>("distance"))[pixel]));
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_TRUE(!found[i].counts || !found[i].as_near_as_first ||
                found[0].number < found[i].number);
  }
}

TEST(Probe, ShowsUnderLensesWhatTheReferenceEngineShows) {
  int shown = 0, ties = 0, not_counted = 0;
  RenderOptions options;
  options.channels = {Channel::Z, Channel::id, Channel::distance};
  for (const LensModel model : {LensModel::simple_radial, LensModel::opencv_14, LensModel::division,
                                LensModel::eucm, LensModel::table}) {
    checks::LensCaseMaker maker(static_cast<std::uint64_t>(model), Kind::few_bits);
    for (std::uint64_t i = 0; i < 40U / effort; ++i) {
      checks::Case c = maker.make(model == LensModel::table ? LensModel::division : model).view;
      if (model == LensModel::table)
        c.camera = checks::with_table(c.camera, checks::DirectionMaker(i).numbers(30));
      const DepthMap map = render_reference(c.scene, c.camera, options).map;
      for (std::uint32_t y = 0; y < c.camera.height; ++y) {
        for (std::uint32_t x = 0; x < c.camera.width; ++x) {
          const auto found = probe(c.scene, c.camera, x, y);
          expect_shown(map, std::size_t{y} * c.camera.width + x, found);
          shown += !found.empty() && found[0].counts ? 1 : 0;
          for (std::size_t k = 0; k < found.size(); ++k) {
            not_counted += found[k].counts ? 0 : 1;
            ties += k > 0 && found[k].as_near_as_first ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_GT(shown, 200 / effort);
  EXPECT_GT(not_counted, 0);
  EXPECT_GT(ties, effort == 1 ? 0 : -1);
}

}  // namespace
}  // namespace fathom
