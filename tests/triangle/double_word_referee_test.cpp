// The tier of double-words between binary64 and exact numbers: what it settles is right, and it
// settles what differs by less than binary64 can tell.
#include "fathom/triangle/double_word_referee.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fathom/numeric/rounding.h"
#include "fathom/triangle/projected_triangle.h"
#include "tests/inputs/random_scenes.h"

namespace fathom {
namespace {

using namespace triangle;
using checks::Case;
using checks::CaseMaker;
using checks::Kind;

int exact_order(const Ratio& a, const Ratio& b) {
  const int order = compare(a, b);
  return order < 0 ? -1 : order > 0 ? 1 : 0;
}

struct Settled {
  int asked = 0, settled = 0;
  void add(bool is_settled) {
    ++asked;
    settled += is_settled;
  }
};

struct Seen {
  Settled coverage, depth, order;
  int coplanar = 0;
};

std::vector<ProjectedTriangle> project_all(const Case& c, const TriangleSource& source) {
  std::vector<ProjectedTriangle> all;
  TierCounts counts;
  for (std::uint32_t n = 0; n < source.count(); ++n) {
    all.push_back(project(source.world_corners(n), n, c.camera, counts));
  }
  return all;
}

/// Every question about every pair of triangles at every sample, against exact numbers.
void check(const Case& c, Seen& seen) {
  const TriangleSource source(c.scene);
  const SceneRays rays(source, c.camera);
  WideReferee referee(rays);
  const std::vector<ProjectedTriangle> all = project_all(c, source);
  for (std::uint32_t pixel = 0; pixel < c.camera.width * c.camera.height; ++pixel) {
    const ImagePoint s{pixel % c.camera.width + 0.5, pixel / c.camera.width + 0.5};
    TierCounts counts;
    for (const ProjectedTriangle& a : all) {
      if (a.orientation == Sign::zero) continue;
      const bool covered = covers(a, s, counts);
      const auto coverage = referee.covers(a.number, s);
      seen.coverage.add(coverage.has_value());
      if (coverage) {
        ASSERT_EQ(*coverage, covered);
      }
      if (!covered) continue;
      const Ratio depth = depth_at(a, s);
      const double limit = std::nextafter(round_to_binary64(depth), 0);
      const auto side = referee.compare_depth(a.number, s, limit);
      seen.depth.add(side.has_value());
      if (side) {
        ASSERT_EQ(*side, exact_order(depth, Ratio(Dyadic(limit))));
      }
      for (const ProjectedTriangle& b : all) {
        if (b.orientation == Sign::zero || !covers(b, s, counts)) continue;
        const int truth = exact_order(depth, depth_at(b, s));
        const auto order = referee.compare_depths(a.number, b.number, s);
        if (truth != 0) seen.order.add(order.has_value());
        if (order) {
          ASSERT_EQ(*order, truth);
        }
        if (referee.lie_in_one_plane(a.number, b.number)) {
          ++seen.coplanar;
          ASSERT_EQ(truth, 0);
        }
      }
    }
  }
}

class WideReferees : public ::testing::TestWithParam<Kind> {};

TEST_P(WideReferees, AreRightAndSettleMost) {
  CaseMaker maker(5150 + static_cast<std::uint64_t>(GetParam()), GetParam());
  Seen seen;
  for (int i = 0; i < 300 && !HasFatalFailure(); ++i) check(maker.make(), seen);
  EXPECT_GT(seen.coplanar, 1000);
  EXPECT_GT(seen.order.asked, 500);
  // The neighbours of 0 are of magnitudes for which no bound was derived; else all that differ.
  EXPECT_GT(seen.order.settled,
            GetParam() == Kind::few_bits ? seen.order.asked - 1 : seen.order.asked * 3 / 4);
  EXPECT_GT(seen.depth.settled, seen.depth.asked * 9 / 10);
  EXPECT_GT(seen.coverage.settled, seen.coverage.asked / 2);
}

INSTANTIATE_TEST_SUITE_P(Fast, WideReferees, ::testing::Values(Kind::few_bits, Kind::neighbours));

MeshPoint plane_point(double x, double y) {
  return {x, y, 3 * x - 5 * y + 7};
}

TEST(WideReferee, CoplanarPointsOfFewBits) {
  const MeshTriangle a{plane_point(0, 0), plane_point(1, 0), plane_point(0, 1)};
  EXPECT_TRUE(certainly_coplanar(a, {plane_point(5, 2.5), plane_point(-3, 8), plane_point(9, 9)}));
  EXPECT_TRUE(certainly_coplanar(a, {a[2], a[0], a[1]}));
  for (std::size_t k = 0; k < 3; ++k) {  // one corner off the plane, by the least step there is
    MeshTriangle b{plane_point(5, 2.5), plane_point(-3, 8), plane_point(9, 9)};
    b[k].z += 0x1p-30;
    EXPECT_FALSE(certainly_coplanar(a, b)) << k;
  }
  // Coordinates too far apart for 39 bits: nothing is known, unless the points are the same.
  const MeshTriangle wide{plane_point(0, 0), plane_point(0x1p20, 0), plane_point(0, 0x1p-20)};
  EXPECT_FALSE(certainly_coplanar(wide, {wide[0], wide[1], plane_point(1, 1)}));
  EXPECT_TRUE(certainly_coplanar(wide, {wide[1], wide[2], wide[0]}));
  // The greatest coordinates: products of three differences just below 2¹²³.
  const double g = 0x1p39 - 1;
  const MeshTriangle great{MeshPoint{-g, -g, -g}, MeshPoint{g, -g, g}, MeshPoint{-g, g, g}};
  EXPECT_TRUE(certainly_coplanar(great, {MeshPoint{0, 0, g}, great[1], great[2]}));
  EXPECT_FALSE(certainly_coplanar(great, {MeshPoint{g, g, g}, great[1], great[2]}));
}

}  // namespace
}  // namespace fathom
