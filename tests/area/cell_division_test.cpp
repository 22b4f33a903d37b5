// Many surfaces in one pixel: divided areas against the oracle's, and that they end at all.
#include <gtest/gtest.h>

#include <map>

#include "fathom/area/cell_coverage.h"
#include "fathom/area/image_cell.h"
#include "fathom/area/visible_fragments.h"
#include "tests/area/crowds.h"
#include "tests/area/surfaces.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using namespace area;
using checks::Crowd;
using checks::plain_camera;
using checks::surfaces_of;
using oracle::Q;

Q area_of(const Boundary& boundary) {
  return checks::rational(exact_area(boundary));
}

class Crowded : public ::testing::TestWithParam<DivisionLimits> {};

TEST_P(Crowded, VisibleAreasAreTheOracles) {
  const Camera camera = plain_camera(1, 1);
  for (const Crowd& crowd : checks::crowds()) {
    SCOPED_TRACE(crowd.name);
    const std::vector<SurfaceRegion> surfaces = surfaces_of(crowd.scene, camera);
    const oracle::Areas areas = checks::areas_at(crowd.scene, camera);
    ImageCell pixel(0, 0);
    CellVisibility all(pixel);
    for (const SurfaceRegion& surface : surfaces) all.add(surface);
    ASSERT_GT(all.size(), GetParam().few);
    std::map<std::uint32_t, Q> in_boundaries, in_polygons;
    Q uncovered = 0;
    divide(
        all,
        [&](CellVisibility& part) {
          uncovered += area_of(part.uncovered());
          for (std::size_t piece = 0; piece < part.size(); ++piece) {
            const std::uint32_t number = part.surface(piece).number;
            in_boundaries[number] += area_of(part.visible(piece));
            for (const ConvexPolygon& polygon : part.visible_polygons(piece)) {
              const Q area = area_of(boundary_of(polygon));
              EXPECT_GT(area, 0);
              in_polygons[number] += area;
            }
          }
        },
        GetParam());
    std::map<std::uint32_t, Q> expected = areas.visible(0, 0);
    for (const SurfaceRegion& surface : surfaces) {
      EXPECT_EQ(in_boundaries[surface.number], expected[surface.number]) << surface.number;
      EXPECT_EQ(in_polygons[surface.number], expected[surface.number]) << surface.number;
    }
    EXPECT_EQ(1 - uncovered, areas.coverage(0, 0));
  }
}

INSTANTIATE_TEST_SUITE_P(Limits, Crowded,
                         ::testing::Values(DivisionLimits{.few = 8}, DivisionLimits{.few = 3},
                                           DivisionLimits{.few = 3, .cuts_in_vain = 0},
                                           DivisionLimits{.few = 2, .cuts = 0}));

TEST(CellDivision, CoverageOfACrowdIsTheOracles) {
  const Camera camera = plain_camera(1, 1);
  for (const Crowd& crowd : checks::crowds(4)) {
    SCOPED_TRACE(crowd.name);
    ImageCell pixel(0, 0);
    CellCoverage coverage(pixel);
    for (const SurfaceRegion& surface : surfaces_of(crowd.scene, camera)) {
      coverage.add(surface.region);
    }
    EXPECT_EQ(checks::rational(coverage.area()),
              checks::areas_at(crowd.scene, camera).coverage(0, 0));
  }
}

// As many as would take minutes if shared edges were cut again and again.
TEST(CellDivision, PartsStayFewWhereFewAreVisible) {
  const Camera camera = plain_camera(1, 1);
  for (const Crowd& crowd :
       {Crowd{"equal triangles", checks::equal_triangles(2000)},
        Crowd{"coins", checks::coins(60, 32)}, Crowd{"facades", checks::facades(1000)}}) {
    SCOPED_TRACE(crowd.name);
    const std::vector<SurfaceRegion> surfaces = surfaces_of(crowd.scene, camera);
    ImageCell pixel(0, 0);
    CellVisibility all(pixel);
    for (const SurfaceRegion& surface : surfaces) all.add(surface);
    std::size_t parts = 0, pieces = 0;
    divide(all, [&](CellVisibility& part) {
      ++parts;
      pieces += part.size();
    });
    EXPECT_LT(parts, 1000U);
    EXPECT_LT(pieces, 2000U);
  }
}

// Surfaces from front to back, without those of which nothing is left: the same is visible.
TEST(CellDivision, WhatIsHiddenByMostIsLeftOut) {
  const Camera camera = plain_camera(1, 1);
  for (const Crowd& crowd : checks::crowds(2)) {
    SCOPED_TRACE(crowd.name);
    const std::vector<SurfaceRegion> surfaces = surfaces_of(crowd.scene, camera);
    std::vector<const SurfaceRegion*> pointers;
    for (const SurfaceRegion& surface : surfaces) pointers.push_back(&surface);
    ImageCell pixel(0, 0);
    CellVisibility all(pixel), some(pixel);
    for (const SurfaceRegion& surface : surfaces) all.add(surface);
    some.add_visible(pointers);
    if (crowd.name == "coins") {
      EXPECT_LT(some.size(), all.size() / 2);
    }
    const auto visible = [](CellVisibility& pieces) {
      std::map<std::uint32_t, Q> areas;
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Q area = area_of(pieces.visible(i));
        if (area != 0) areas[pieces.surface(i).number] = area;
      }
      return areas;
    };
    EXPECT_EQ(visible(some), visible(all));
  }
}

}  // namespace
}  // namespace fathom
