// Visible areas inside pixels against areas computed cell by cell in rational numbers.
#include "fathom/area/visible_fragments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/area/coverage.h"
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
using checks::surfaces_of;
using oracle::Q;

struct Tally {
  int fragments = 0, partly_hidden = 0, hidden = 0, crossing = 0;
};

/// Whether two pieces change places within the pixel.
bool cross(const SurfaceRegion& s, const SurfaceRegion& t, const ImageCell& pixel) {
  return !pixel.sign_in_cell(in_front(s, t));
}

/// Holds every visible area in a pixel to the oracle's, and their sum to the coverage.
void check_pixel(const std::vector<SurfaceRegion>& surfaces, const oracle::Areas& areas,
                 std::uint32_t x, std::uint32_t y, bool drop, Tally& tally) {
  SCOPED_TRACE("pixel " + std::to_string(x) + ", " + std::to_string(y));
  const auto column = static_cast<int>(x), row = static_cast<int>(y);
  ImageCell pixel(x, y);
  CellVisibility visibility(pixel);
  for (const SurfaceRegion& surface : surfaces) visibility.add(surface);
  if (drop) visibility.drop_hidden();
  std::map<std::uint32_t, Q> expected = areas.visible(column, row);
  Q sum = 0;
  for (std::size_t piece = 0; piece < visibility.size(); ++piece) {
    const std::uint32_t number = visibility.surface(piece).number;
    const Boundary boundary = visibility.visible(piece);
    const Q found = checks::rational(exact_area(boundary));
    ASSERT_EQ(found, expected[number]) << "triangle " << number;
    EXPECT_EQ(boundary.empty(), sgn(found) == 0);
    const Interval around = enclose(approximate_area(boundary));
    EXPECT_LE(Q(around.lower), found);
    EXPECT_GE(Q(around.upper), found);
    sum += found;
    const Q whole = areas.unoccluded(number, column, row);
    ++(sgn(found) == 0 ? tally.hidden : found == whole ? tally.fragments : tally.partly_hidden);
    for (std::size_t s = 0; s < piece; ++s) {
      tally.crossing += cross(visibility.surface(s), visibility.surface(piece), pixel);
    }
    expected.erase(number);
  }
  for (const auto& [number, area] : expected) {
    ASSERT_EQ(sgn(area), 0) << "triangle " << number << " is visible and has no piece";
  }
  const Q rest = checks::rational(exact_area(visibility.uncovered()));
  EXPECT_EQ(sum, areas.coverage(column, row));
  EXPECT_EQ(sum + rest, 1);
}

class Visible : public ::testing::TestWithParam<Kind> {};

TEST_P(Visible, AreasAreTheOraclesAndAddUpToCoverage) {
  CaseMaker maker(4004 + static_cast<std::uint64_t>(GetParam()), GetParam());
  Tally tally;
  for (int i = 0; i < 400 / checks::effort && !HasFatalFailure(); ++i) {
    SCOPED_TRACE("scene " + std::to_string(i) + " of this seed");
    const Case c = maker.make();
    const std::vector<SurfaceRegion> surfaces = surfaces_of(c.scene, c.camera);
    const oracle::Areas areas = checks::areas_at(c.scene, c.camera);
    for (std::uint32_t pixel = 0; pixel < 30; pixel += 4) {
      check_pixel(surfaces, areas, pixel % 6, pixel / 6, i % 2 == 0, tally);
    }
  }
  if (checks::effort > 1) return;
  EXPECT_GT(tally.fragments, 50);
  EXPECT_GT(tally.partly_hidden, 50);
  EXPECT_GT(tally.hidden, 50);
  EXPECT_GT(tally.crossing, 20);
}

INSTANTIATE_TEST_SUITE_P(RandomScenes, Visible,
                         ::testing::Values(Kind::few_bits, Kind::neighbours, Kind::huge,
                                           Kind::tiny));

// Three bars, each over the next, and one that goes through them: no order by depth exists.
TEST(VisibleFragments, ACycleAndAPenetration) {
  const Scene scene = scene_of({{-3, -1, 3},
                                {3, -1, 5},
                                {3, 0, 5},  //
                                {2, -3, 3},
                                {-1, 3, 5},
                                {0, 3, 5},  //
                                {-3, 3, 3},
                                {1, -3, 5},
                                {-1, -3, 5},  //
                                {-3, -3, 2},
                                {3, -2, 6},
                                {0, 3, 4}},
                               {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}});
  const Camera camera = camera_of(4, 4, 4);
  const std::vector<SurfaceRegion> surfaces = surfaces_of(scene, camera);
  const oracle::Areas areas = checks::areas_at(scene, camera);
  Tally tally;
  for (std::uint32_t pixel = 0; pixel < 16; ++pixel) {
    check_pixel(surfaces, areas, pixel % 4, pixel / 4, true, tally);
  }
  EXPECT_GT(tally.crossing, 0);
}

/// Triangles of all sizes in one pixel, pieces of a mesh, one that is there five times.
Scene crowd(std::mt19937_64& random, int count) {
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  const auto number = [&] { return static_cast<double>(random() % 4096) / 4096; };
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    const double size = std::ldexp(1, -static_cast<int>(random() % 5));
    const double x = number() - 0.5, y = number() - 0.5, z = 1 + number();
    for (int k = 0; k < 4; ++k) {
      vertices.push_back(
          {x + size * (number() - 0.5), y + size * (number() - 0.5), z + size * (number() - 0.5)});
    }
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first + 1, first + 3, first + 2});
  }
  for (int i = 0; i < 4; ++i) triangles.push_back(triangles[7]);
  return scene_of(std::move(vertices), std::move(triangles));
}

// Divided into simple parts or asked at once: the same areas, exactly, and the same depths.
TEST(VisibleFragments, DivisionChangesNothing) {
  std::mt19937_64 random(1969);
  const Scene scene = crowd(random, 13);
  Camera camera = camera_of(1, 1, 1);
  const std::vector<SurfaceRegion> surfaces = surfaces_of(scene, camera);
  ImageCell pixel(0, 0);
  CellVisibility visibility(pixel);
  for (const SurfaceRegion& surface : surfaces) visibility.add(surface);
  ASSERT_GT(visibility.size(), 24U);
  for (const DivisionLimits limits : {DivisionLimits{.few = 8}, DivisionLimits{}}) {
    std::map<const SurfaceRegion*, Boundary> divided;
    int parts = 0;
    Q uncovered = 0;
    divide(
        visibility,
        [&](CellVisibility& part) {
          ++parts;
          uncovered += checks::rational(exact_area(part.uncovered()));
          for (std::size_t piece = 0; piece < part.size(); ++piece) {
            const Boundary more = part.visible(piece);
            Boundary& all = divided[&part.surface(piece)];
            all.insert(all.end(), more.begin(), more.end());
          }
        },
        limits);
    EXPECT_GT(parts, 1);
    EXPECT_EQ(uncovered, checks::rational(exact_area(visibility.uncovered())));
    std::vector<ConvexPolygon> polygons;
    for (std::size_t piece = 0; piece < visibility.size(); ++piece) {
      SCOPED_TRACE(piece);
      polygons.push_back(visibility.polygon(piece));
      const SurfaceRegion& surface = visibility.surface(piece);
      const Boundary whole = visibility.visible(piece);
      const Boundary& found = divided[&surface];
      ASSERT_EQ(checks::rational(exact_area(found)), checks::rational(exact_area(whole)));
      ASSERT_EQ(found.empty(), whole.empty());
      if (whole.empty()) continue;
      const CellDepths depths(pixel, surface);
      EXPECT_EQ(depths.extent(found).nearest, depths.extent(whole).nearest);
      EXPECT_EQ(depths.extent(found).farthest, depths.extent(whole).farthest);
    }
    TierCounts counts;
    Q covered = 0;
    for_each_simple_part(pixel, polygons, counts, [&](std::span<const ConvexPolygon> part) {
      covered += checks::rational(exact_area(boundary_of_union(part, counts)));
    });
    EXPECT_EQ(covered, 1 - uncovered);
  }
}

/// The depth of the plane at the corners of what is visible, on paper.
TEST(VisibleFragments, DepthsAreThoseOfTheVisiblePartAlone) {
  // Orthographic, D = 2 + u over the pixel; its left half is hidden by a nearer square.
  Camera camera = camera_of(1, 1, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0;
  const Scene scene = scene_of({{-4, -4, -2},
                                {8, -4, 10},
                                {-4, 8, -2},  //
                                {-1, -1, 1},
                                {0.5, -1, 1},
                                {0.5, 5, 1},
                                {-1, 5, 1}},
                               {{0, 1, 2}, {3, 4, 5}, {3, 5, 6}});
  const std::vector<SurfaceRegion> surfaces = surfaces_of(scene, camera);
  ImageCell pixel(0, 0);
  CellVisibility visibility(pixel);
  for (const SurfaceRegion& surface : surfaces) visibility.add(surface);
  const Boundary boundary = visibility.visible(0);
  EXPECT_EQ(checks::rational(exact_area(boundary)), Q(1, 2));
  const CellDepths::Extent extent = CellDepths(pixel, surfaces[0]).extent(boundary);
  EXPECT_EQ(extent.nearest, 2.5F);
  EXPECT_EQ(extent.farthest, 3.0F);
}

}  // namespace
}  // namespace fathom
