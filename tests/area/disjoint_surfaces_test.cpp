// Whether two triangles have no area in common on the image, by their edges, against the areas of
// both and of their union in rational numbers.
#include <gtest/gtest.h>

#include "fathom/area/image_cell.h"
#include "tests/area/surfaces.h"
#include "tests/effort.h"
#include "tests/inputs/random_scenes.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using namespace area;
using namespace triangle;
using checks::camera_of;
using checks::Case;
using checks::CaseMaker;
using checks::Kind;
using checks::scene_of;
using checks::surfaces_by_number;
using oracle::Q;

/// The area that both triangles of a scene cover in the image.
Q common_area(const Scene& scene, const Camera& camera) {
  const oracle::Areas areas = checks::areas_at(scene, camera);
  Q sum = 0;
  for (int y = 0; y < static_cast<int>(camera.height); ++y) {
    for (int x = 0; x < static_cast<int>(camera.width); ++x) {
      sum += areas.unoccluded(0, x, y) + areas.unoccluded(1, x, y) - areas.coverage(x, y);
    }
  }
  return sum;
}

class Disjoint : public ::testing::TestWithParam<Kind> {};

TEST_P(Disjoint, IsSaidOnlyOfTrianglesWithoutACommonArea) {
  CaseMaker maker(1977 + static_cast<std::uint64_t>(GetParam()), GetParam());
  int apart = 0, overlapping = 0;
  for (int i = 0; i < 2000 / checks::effort; ++i) {
    Case c = maker.make();
    auto& triangles = c.scene.meshes[0].triangles;
    triangles.resize(2);
    const auto surfaces = surfaces_by_number(c.scene, c.camera);
    if (!surfaces[0] || !surfaces[1]) continue;
    const bool disjoint = are_disjoint(*surfaces[0], *surfaces[1]);
    EXPECT_EQ(are_disjoint(*surfaces[1], *surfaces[0]), disjoint);
    const bool overlap = sgn(common_area(c.scene, c.camera)) != 0;
    ASSERT_FALSE(disjoint && overlap) << "scene " << i << " of this seed";
    apart += disjoint;
    overlapping += overlap;
  }
  if (checks::effort > 1) return;
  EXPECT_GT(apart, 50);
  EXPECT_GT(overlapping, 50);
}

INSTANTIATE_TEST_SUITE_P(RandomScenes, Disjoint,
                         ::testing::Values(Kind::few_bits, Kind::neighbours, Kind::huge,
                                           Kind::tiny));

// Corners in common, and corners on the lines of others' edges, whose images are no short numbers.
TEST(DisjointSurfaces, AllTrianglesOfASheetAreToldApart) {
  constexpr std::uint32_t side = 5;
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const double x = 0.1 * (i % side), y = 0.1 * (i / side);
    vertices.push_back({x, y, 1 + x / 3});
  }
  for (std::uint32_t y = 0; y + 1 < side; ++y) {
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t at = y * side + x;
      triangles.push_back({at, at + 1, at + side});
      triangles.push_back({at + 1, at + side + 1, at + side});
    }
  }
  Camera camera = camera_of(64, 64, 100);
  const auto surfaces =
      surfaces_by_number(scene_of(std::move(vertices), std::move(triangles)), camera);
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    for (std::size_t t = 0; t < s; ++t) {
      EXPECT_TRUE(are_disjoint(*surfaces[s], *surfaces[t])) << s << " and " << t;
    }
    EXPECT_FALSE(are_disjoint(*surfaces[s], *surfaces[s]));
  }
}

// Their planes and corners are the same, as those of a fold are; one reaches behind the camera.
TEST(DisjointSurfaces, AFoldOverlapsAndWhatIsBehindTheCameraIsNoExcuse) {
  const Camera camera = camera_of(8, 8, 4);
  const auto fold = surfaces_by_number(
      scene_of({{-0.5, 0, 2}, {0.5, 0, 2}, {0, 0.5, 2}, {0, 0.7, 3}}, {{0, 1, 2}, {1, 0, 3}}),
      camera);
  EXPECT_FALSE(are_disjoint(*fold[0], *fold[1]));
  const auto across = surfaces_by_number(
      scene_of({{-1, 1, 4}, {1, 1, 4}, {0, -1, -3}, {-1, 0, 3}, {1, 0, 3}, {0, -1, 3}},
               {{0, 1, 2}, {3, 4, 5}}),
      camera);
  EXPECT_FALSE(are_disjoint(*across[0], *across[1]));
}

}  // namespace
}  // namespace fathom
