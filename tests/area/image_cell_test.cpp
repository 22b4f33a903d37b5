// Rectangles of the image, what triangles cover of them, and their halves.
#include "fathom/area/image_cell.h"

#include <gtest/gtest.h>

#include "fathom/area/cell_coverage.h"
#include "fathom/triangle/projected_triangle.h"
#include "tests/area/surfaces.h"
#include "tests/effort.h"
#include "tests/inputs/random_scenes.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using namespace area;
using namespace triangle;
using checks::CaseMaker;
using checks::Kind;
using checks::plain_camera;
using checks::scene_of;
using checks::surfaces_of;
using oracle::Q;

Q area_of(const ConvexPolygon& polygon) {
  TierCounts counts;
  return checks::rational(exact_area(boundary_of_union(std::span(&polygon, 1), counts)));
}

/// Points with D > 0 in the range are those at which no form is negative.
TEST(CoveredRegion, IsWhatCoversAndCounts) {
  int inside = 0, outside = 0;
  for (const Kind kind : {Kind::few_bits, Kind::neighbours}) {
    CaseMaker maker(151 + static_cast<std::uint64_t>(kind), kind);
    std::mt19937_64 random(5);
    for (int i = 0; i < 300 / checks::effort; ++i) {
      const checks::Case c = maker.make();
      const TriangleSource triangles(c.scene);
      for (std::uint32_t number = 0; number < triangles.count(); ++number) {
        TierCounts counts;
        const auto t = project(triangles.world_corners(number), number, c.camera, counts);
        const auto region = covered_region(t, c.camera);
        for (int k = 0; k < 12; ++k) {
          const ImagePoint s{static_cast<double>(random() % 6144) / 1024,
                             static_cast<double>(random() % 5120) / 1024};
          bool on_rim = false, is_inside = region.has_value();
          for (const LinearForm& form : region.value_or(std::vector<LinearForm>())) {
            const Sign sign = form.at(s.u, s.v).sign();
            on_rim = on_rim || sign == Sign::zero;
            is_inside = is_inside && sign == Sign::positive;
          }
          if (on_rim) continue;
          const bool counts_there = t.orientation != Sign::zero && covers(t, s, counts) &&
                                    is_in_range(depth_at(t, s), c.camera);
          ASSERT_EQ(is_inside, counts_there);
          ++(is_inside ? inside : outside);
        }
      }
    }
  }
  EXPECT_GT(inside, 500 / checks::effort);
  EXPECT_GT(outside, 5000 / checks::effort);
}

TEST(ImageCell, FormsAreTakenToItsOwnCorner) {
  const ImageCell cell(7, 2000000, 3, 2);
  const LinearForm form({0.5, -3.0, 11.0});
  const ExactVector3 l = cell.localised(form);
  for (const double x : {0.0, 1.25, 3.0}) {
    for (const double y : {0.0, 0.5, 2.0}) {
      EXPECT_EQ(l[0] * Dyadic(x) + l[1] * Dyadic(y) + l[2], form.at(7 + x, 2000000 + y));
    }
  }
  EXPECT_EQ(area_of(cell.whole()), 6);
  EXPECT_EQ(cell.all().corner(0).u, 7);
  EXPECT_EQ(cell.all().corner(3).u, 10);
  EXPECT_EQ(cell.all().corner(3).v, 2000002);
}

/// The pixels of an image give the areas that slabs of rational numbers do.
TEST(ImageCell, CutsOutWhatATriangleCovers) {
  int pieces = 0, wholes = 0;
  CaseMaker maker(152, Kind::few_bits);
  for (int i = 0; i < 60 / checks::effort + 1; ++i) {
    const checks::Case c = maker.make();
    const auto areas = checks::areas_at(c.scene, c.camera);
    for (const SurfaceRegion& surface : surfaces_of(c.scene, c.camera)) {
      for (std::uint32_t y = 0; y < c.camera.height; ++y) {
        for (std::uint32_t x = 0; x < c.camera.width; ++x) {
          ImageCell pixel(x, y);
          TierCounts counts;
          const auto piece = pixel.clip(surface.region, counts);
          const Q exact =
              areas.unoccluded(surface.number, static_cast<int>(x), static_cast<int>(y));
          ASSERT_EQ(piece ? area_of(piece->polygon) : Q(0), exact);
          if (!piece) continue;
          ++pieces;
          wholes += piece->is_whole;
          ASSERT_EQ(piece->is_whole, exact == 1);
          EXPECT_EQ(pixel.all().is_all(piece->polygon), exact == 1);
        }
      }
    }
  }
  EXPECT_GT(pieces, 100 / checks::effort);
  EXPECT_GT(wholes, 10 / checks::effort);
}

TEST(ImageCell, HalvesAreHalves) {
  ImageCell cell(3, 4, 4, 2);
  std::vector<CellPart> parts{cell.all()};
  Q part_area = 8;
  for (int cut = 0; cut < 7; ++cut) {
    std::vector<CellPart> next;
    for (const CellPart& part : parts) {
      for (const ImageCell::Half& half : cell.halves(part)) {
        const CellPart& p = half.part;
        ASSERT_EQ(area_of(p.outline), part_area / 2);
        ASSERT_EQ(Q(p.right - p.left) * Q(p.bottom - p.top), part_area / 2);
        ASSERT_TRUE(p.is_side(half.side));
        ASSERT_FALSE(cell.is_side(half.side));
        ASSERT_LE(std::max(p.right - p.left, p.bottom - p.top),
                  2 * std::min(p.right - p.left, p.bottom - p.top));
        next.push_back(p);
      }
    }
    parts = std::move(next);
    part_area /= 2;
  }
  EXPECT_EQ(parts.size(), 128U);
}

TEST(ImageCell, SignsAreThoseOfTheWholePart) {
  ImageCell pixel(2, 3);
  const auto sign = [&](double a, double b, double c) {
    return pixel.sign_in_cell(LinearForm({a, b, c}));
  };
  EXPECT_EQ(sign(0, 0, 1), Sign::positive);
  EXPECT_EQ(sign(1, 1, -4.75), Sign::positive);  // least value 0.25
  EXPECT_EQ(sign(1, 0, -3.5), Sign::negative);
  EXPECT_EQ(sign(1, 0, -2.5), std::nullopt);  // u = 2.5 divides the pixel
  const auto halves = pixel.halves(pixel.all());
  ASSERT_EQ(halves.size(), 2U);
  EXPECT_EQ(halves[0].part.sign_of(LinearForm({1.0, 0.0, -2.75})), Sign::negative);
  EXPECT_EQ(halves[1].part.sign_of(LinearForm({1.0, 0.0, -2.25})), Sign::positive);
}

TEST(CellCoverage, IsCompleteOnceOneCoversAll) {
  const Scene scene =
      scene_of({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {-5, -5, 1}, {9, -5, 1}, {-5, 9, 1}},
               {{0, 1, 2}, {3, 4, 5}});
  const auto surfaces = surfaces_of(scene, plain_camera(1, 1));
  ImageCell pixel(0, 0);
  CellCoverage coverage(pixel);
  coverage.add(surfaces[0].region);
  EXPECT_FALSE(coverage.is_complete());
  EXPECT_EQ(checks::rational(coverage.area()), Q(1, 2));
  EXPECT_EQ(coverage.rounded_area(), 0.5F);
  coverage.add(surfaces[1].region);
  EXPECT_TRUE(coverage.is_complete());
  EXPECT_EQ(checks::rational(coverage.area()), 1);
  EXPECT_EQ(coverage.rounded_area(), 1);
}

}  // namespace
}  // namespace fathom
