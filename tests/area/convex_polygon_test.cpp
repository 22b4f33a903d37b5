// Convex polygons by their edges alone against Sutherland and Hodgman's corners in rational
// numbers.
#include "fathom/area/convex_polygon.h"

#include <gtest/gtest.h>

#include "fathom/area/convex_union.h"
#include "tests/area/lines.h"
#include "tests/effort.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using namespace area;
using checks::Lines;
using oracle::Q;

Q area_of(const ConvexPolygon& polygon) {
  TierCounts counts;
  return checks::rational(exact_area(boundary_of_union(std::span(&polygon, 1), counts)));
}

TEST(ConvexPolygon, IsCutAsItsCornersAre) {
  std::mt19937_64 random(131);
  TierCounts counts;
  int empty = 0, touched = 0;
  for (int i = 0; i < 3000 / checks::effort; ++i) {
    Lines lines;
    Lines::Both polygon = lines.rectangle(-4, -4, 4, 4);
    for (int cut = 0; cut < 6; ++cut) {
      const checks::Line l = checks::random_line(random);
      const std::size_t before = polygon.ours.edges().size();
      const bool left = lines.clip(polygon, l, counts);
      ASSERT_EQ(left, sgn(checks::area_of(polygon.exact)) > 0);
      if (!left) {
        ++empty;
        break;
      }
      // None of the edges is superfluous.
      polygon.exact = oracle::without_superfluous(polygon.exact);
      ASSERT_EQ(polygon.ours.edges().size(), polygon.exact.size());
      ASSERT_EQ(area_of(polygon.ours), checks::area_of(polygon.exact));
      touched += polygon.ours.edges().size() == before;
      const BoundingRectangle& box = polygon.ours.bounds();
      for (const oracle::Point& p : polygon.exact) {
        ASSERT_TRUE(Q(box.u.lower) <= p[0] && p[0] <= Q(box.u.upper));
        ASSERT_TRUE(Q(box.v.lower) <= p[1] && p[1] <= Q(box.v.upper));
      }
    }
  }
  EXPECT_GT(empty, 200 / checks::effort);
  EXPECT_GT(touched, 200 / checks::effort);
  EXPECT_GT(counts.exact, 800U / checks::effort);
}

TEST(ConvexPolygon, NeighboursFollowEachOtherAround) {
  Lines lines;
  const ConvexPolygon square = lines.rectangle(0, 0, 1, 1).ours;
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(&square.after(k), square.edges()[(k + 1) % 4]);
    EXPECT_EQ(&square.before((k + 1) % 4), square.edges()[k]);
    TierCounts counts;
    EXPECT_EQ(sign_of_turn(*square.edges()[k], square.after(k), counts), Sign::positive);
  }
}

TEST(ConvexPolygon, BoxesMeetUnlessTheyAreApart) {
  Lines lines;
  const BoundingRectangle one = lines.rectangle(0, 0, 1, 1).ours.bounds();
  EXPECT_TRUE(one.may_meet(lines.rectangle(1, 1, 2, 2).ours.bounds()));
  EXPECT_TRUE(one.may_meet({}));
  EXPECT_FALSE(one.may_meet(lines.rectangle(1.5, 0, 2, 1).ours.bounds()));
  EXPECT_FALSE(one.may_meet(lines.rectangle(0, -2, 1, -1).ours.bounds()));
}

TEST(ConvexPolygon, CrossingsLieWithinTheirBounds) {
  std::mt19937_64 random(132);
  int known = 0;
  for (int i = 0; i < 3000; ++i) {
    const checks::Line l = checks::random_line(random), m = checks::random_line(random);
    const Q turn = Q(l.a) * Q(m.b) - Q(l.b) * Q(m.a);
    if (sgn(turn) == 0) continue;
    const Q u = (Q(l.b) * Q(m.c) - Q(l.c) * Q(m.b)) / turn,
            v = (Q(l.c) * Q(m.a) - Q(l.a) * Q(m.c)) / turn;
    const HalfPlane a({l.a, l.b, l.c}), b({m.a, m.b, m.c});
    const CertifiedPoint p = approximate_crossing(a, b);
    for (const auto& [found, exact] : {std::pair{p.u, u}, std::pair{p.v, v}}) {
      if (!std::isfinite(found.error)) continue;
      ++known;
      ASSERT_LE(abs(Q(Q(found.value) - exact)), Q(found.error));
      EXPECT_LT(found.error, 0x1p-40);
    }
  }
  EXPECT_GT(known, 3000);
}

}  // namespace
}  // namespace fathom
