// Inside and outside, convexity, hull and tessellation.

#include "fathom/pipeline/scan/polygon_tests.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/convex_hull_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "fathom/pipeline/scan/area_fill.h"
#include "fathom/pipeline/scan/edge_function.h"
#include "fathom/pipeline/scan/tessellate.h"
#include "tests/effort.h"
#include "tests/pipeline/scan/rings.h"

namespace fathom::pipeline {
namespace {

using checks::Corners;

Ring<Exact> ring_of_corners(const Corners& corners) {
  Ring<Exact> ring;
  for (const auto& [x, y] : corners) ring.push_back({Exact(x), Exact(y)});
  return ring;
}

const Corners square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
const Corners l_shape{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
/// Every second corner of a pentagon: turns one way only, but goes round twice.
const Corners star{{8, 0}, {13, 15}, {0, 6}, {16, 6}, {3, 15}};

TEST(Convexity, SquareYesLShapeNo) {
  const Convexity s = convexity_of(ring_of_corners(square)),
                  l = convexity_of(ring_of_corners(l_shape));
  EXPECT_TRUE(s.convex);
  EXPECT_TRUE(s.corners_on_one_side);
  EXPECT_EQ(s.turning_number, -1);  // drawn clockwise as seen
  EXPECT_FALSE(l.convex);
  EXPECT_FALSE(l.corners_on_one_side);
  EXPECT_EQ(l.turning_number, -1);
}

TEST(Convexity, DotProductsOfNeighbouringEdgesSayNothing) {
  // All of them are 0, for the convex square and the concave L alike.
  for (const Corners& corners : {square, l_shape}) {
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
      const auto [ax, ay] = corners[i];
      const auto [bx, by] = corners[(i + 1) % n];
      const auto [cx, cy] = corners[(i + 2) % n];
      EXPECT_EQ((bx - ax) * (cx - bx) + (by - ay) * (cy - by), 0);
    }
  }
}

TEST(Convexity, APentagramTurnsOneWayButTwice) {
  const Convexity c = convexity_of(ring_of_corners(star));
  for (const int turn : c.turns) EXPECT_EQ(turn, c.turns[0]);
  EXPECT_EQ(std::abs(c.turning_number.value()), 2);
  EXPECT_FALSE(c.convex);
}

TEST(Convexity, BothTestsAgreeOnRandomSimpleAndCrossedRings) {
  std::mt19937 random(21);
  std::uniform_int_distribution<int> coordinate(0, 6), corners(3, 6);
  int convex = 0;
  for (int i = 0; i < 4000 / checks::effort; ++i) {
    Corners ring;
    for (int k = corners(random); k > 0; --k)
      ring.push_back({coordinate(random), coordinate(random)});
    const Convexity c = convexity_of(ring_of_corners(ring));
    if (!c.turning_number) continue;  // repeats or turns back: no ring
    // Corners on one side of every edge and once around is what convex means.
    if (c.convex) {
      ++convex;
      ASSERT_TRUE(c.corners_on_one_side);
    } else if (c.corners_on_one_side) {
      ASSERT_NE(std::abs(*c.turning_number), 1);
    }
  }
  EXPECT_GT(convex, 300 / checks::effort);
}

TEST(Inside, LeftOfEveryEdgeHoldsForConvexRingsOnly) {
  const Point<Exact> in_l{Exact(1), Exact(3)};
  EXPECT_EQ(ray_crossings<Exact>({ring_of_corners(l_shape)}, in_l).count % 2, 1);
  EXPECT_FALSE(is_on_one_side_of_every_edge(ring_of_corners(l_shape), in_l));
  const Point<Exact> in_square{Exact(1), Exact(3)};
  EXPECT_TRUE(is_on_one_side_of_every_edge(ring_of_corners(square), in_square));
}

TEST(Inside, ARayThroughCornersCountsThemHalfOpen) {
  // The ray from (1, 2) runs through the corners (4, 2) and (2, 2) and along the edge between them.
  const RayCrossings ray = ray_crossings<Exact>({ring_of_corners(l_shape)}, {Exact(1), Exact(2)});
  EXPECT_EQ(ray.count % 2, 1);
  EXPECT_FALSE(ray.on_outline);
  // A line in both directions, as the source has it, would meet the outline an even number of
  // times.
  Ring<Exact> mirrored = ring_of_corners(l_shape);
  for (auto& p : mirrored) p.x = -p.x;
  const RayCrossings left = ray_crossings<Exact>({mirrored}, {Exact(-1), Exact(2)});
  EXPECT_EQ((ray.count + left.count) % 2, 0);
}

TEST(Inside, WindingOfTheStarIsTwoInItsMiddle) {
  const RayCrossings ray = ray_crossings<Exact>({ring_of_corners(star)}, {Exact(8), Exact(8)});
  EXPECT_EQ(ray.count, 2);
  EXPECT_EQ(std::abs(ray.winding), 2);
}

/// Turns, the turning number, the winding number, edge functions and the windings of crossings all
/// call counter-clockwise as seen positive.
TEST(Orientation, IsTheSameForEveryQuestion) {
  const auto expect = [](const Corners& corners, const Point<Exact>& p, int orientation) {
    const Ring<Exact> ring = ring_of_corners(corners);
    const Convexity c = convexity_of(ring);
    EXPECT_EQ(c.turning_number, orientation);
    EXPECT_EQ(ray_crossings<Exact>({ring}, p).winding, orientation);
    FillPolygon<Exact> polygon(1);
    for (const auto& corner : ring) polygon[0].push_back({corner.x, corner.y, {}});
    const auto row = floor_of(p.y);  // p is a centre
    fill_polygon<Exact>(polygon, FillRule::non_zero, {}, [&](const ScanLine<Exact>& line) {
      int winding = 0;
      for (const auto& crossing : line.crossings)
        if (crossing.x < p.x) winding += crossing.winding;
      if (line.y == row) {
        EXPECT_EQ(winding, orientation);
      }
    });
    for (const int turn : c.turns) EXPECT_EQ(turn, orientation > 0 ? 1 : -1);
  };
  const Exact half = Exact(1) / 2;
  const Point<Exact> in_square{1 + half, 1 + half}, in_star{8 + half, 8 + half};
  // On the screen: to the right along the top, down, and back is clockwise.
  const auto reversed = [](Corners corners) {
    std::reverse(corners.begin(), corners.end());
    return corners;
  };
  expect(square, in_square, -1);
  expect(reversed(square), in_square, 1);
  expect(star, in_star, -2);
  expect(reversed(star), in_star, 2);
  const Ring<Exact> s = ring_of_corners(square);
  EXPECT_TRUE(edge_functions<Exact>({s[0], s[1], s[2]})->turned);
  EXPECT_FALSE(edge_functions<Exact>({s[2], s[1], s[0]})->turned);
  EXPECT_LT(left_of(s[0], s[1], s[2]), 0);
}

TEST(ConvexHull, IsCgals) {
  using Kernel = CGAL::Simple_cartesian<Exact>;
  std::mt19937 random(31);
  std::uniform_int_distribution<int> coordinate(0, 12), count(1, 30);
  for (int i = 0; i < 500 / checks::effort; ++i) {
    std::vector<Point<Exact>> points;
    std::vector<Kernel::Point_2> theirs, hull;
    for (int k = count(random); k > 0; --k) {
      const Exact x(coordinate(random)), y(coordinate(random));
      points.push_back({x, y});
      theirs.emplace_back(x, y);
    }
    CGAL::convex_hull_2(theirs.begin(), theirs.end(), std::back_inserter(hull));
    std::vector<std::pair<Exact, Exact>> ours_sorted, theirs_sorted;
    const Ring<Exact> ours = convex_hull(points);
    for (const auto& p : ours) ours_sorted.emplace_back(p.x, p.y);
    for (const auto& p : hull) theirs_sorted.emplace_back(p.x(), p.y());
    std::sort(ours_sorted.begin(), ours_sorted.end());
    std::sort(theirs_sorted.begin(), theirs_sorted.end());
    ASSERT_EQ(ours_sorted, theirs_sorted);
    if (ours.size() < 3) continue;
    for (std::size_t k = 0; k < ours.size(); ++k)  // counter-clockwise as seen
      ASSERT_GT(left_of(ours[k], ours[(k + 1) % ours.size()], ours[(k + 2) % ours.size()]), 0);
  }
}

TEST(ConvexHull, HoldsEveryConvexCombination) {
  std::mt19937 random(32);
  std::uniform_int_distribution<int> coordinate(0, 40), weight(0, 9);
  for (int i = 0; i < 300 / checks::effort; ++i) {
    std::vector<Point<Exact>> points;
    std::vector<Exact> weights;
    Exact x(0), y(0), sum(0);
    for (int k = 0; k < 7; ++k) {
      points.push_back({Exact(coordinate(random)), Exact(coordinate(random))});
      const Exact t(weight(random));
      weights.push_back(t);
      x += t * points.back().x, y += t * points.back().y, sum += t;
    }
    if (sum == 0) continue;
    const Ring<Exact> hull = convex_hull(points);
    ASSERT_TRUE(is_on_one_side_of_every_edge(hull, {Exact(x / sum), Exact(y / sum)}));
    ASSERT_EQ(combination(points, weights), (Point<Exact>{Exact(x / sum), Exact(y / sum)}));
    ASSERT_TRUE(is_in_hull(hull, combination(points, weights)));
  }
}

TEST(ConvexHull, NegativeWeightsLeaveIt) {
  const Ring<Exact> corners = ring_of_corners({{0, 0}, {4, 0}, {0, 4}});
  const Ring<Exact> hull = convex_hull(corners);
  const auto lies_in = [&](int a, int b, int c) {
    return is_in_hull(hull, combination<Exact>(corners, {Exact(a), Exact(b), Exact(c)}));
  };
  // Of a triangle the weights are its barycentric coordinates: inside is where none is negative.
  for (int a = -2; a <= 5; ++a)
    for (int b = -2; b <= 5; ++b)
      for (int c = -2; c <= 5; ++c)
        if (a + b + c > 0) {
          EXPECT_EQ(lies_in(a, b, c), a >= 0 && b >= 0 && c >= 0) << a << " " << b << " " << c;
        }
}

TEST(ConvexHull, OfAPointAndOfASegmentHoldsWhatLiesOnThem) {
  const Ring<Exact> point = ring_of_corners({{1, 2}}), segment = ring_of_corners({{0, 0}, {4, 2}});
  EXPECT_TRUE(is_in_hull(point, point[0]));
  EXPECT_FALSE(is_in_hull(point, segment[0]));
  EXPECT_TRUE(is_in_hull<Exact>(segment, {Exact(2), Exact(1)}));
  EXPECT_FALSE(is_in_hull<Exact>(segment, {Exact(6), Exact(3)}));
  EXPECT_FALSE(is_in_hull<Exact>(segment, {Exact(2), Exact(2)}));
  EXPECT_FALSE(is_in_hull<Exact>({}, {Exact(0), Exact(0)}));
}

Exact area_of(const std::array<Point<Exact>, 3>& t) {
  return (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
}

bool is_in_triangle(const std::array<Point<Exact>, 3>& t, const Point<Exact>& p) {
  return is_on_one_side_of_every_edge<Exact>({t[0], t[1], t[2]}, p);
}

TEST(Tessellate, CoversTheInsideOnceAndNothingElse) {
  std::mt19937 random(41);
  std::uniform_int_distribution<int> coordinate(0, 12), corners(3, 8), fine(1, 3600);
  for (int i = 0; i < 60 / checks::effort + 1; ++i) {
    Rings<Exact> rings(1 + i % 3);
    for (auto& ring : rings)
      for (int k = corners(random); k > 0; --k)
        ring.push_back({Exact(coordinate(random)), Exact(coordinate(random))});
    const auto triangles = tessellate(rings);
    for (const auto& t : triangles) ASSERT_GT(area_of(t), 0);
    for (int k = 0; k < 60; ++k) {
      // 3607 is a prime, so that hardly a point lies on an edge; those that do are left out.
      const Point<Exact> p{Exact(12 * fine(random)) / Exact(3607),
                           Exact(12 * fine(random)) / Exact(3607)};
      const RayCrossings ray = ray_crossings(rings, p);
      const auto covering = std::count_if(triangles.begin(), triangles.end(),
                                          [&](const auto& t) { return is_in_triangle(t, p); });
      if (!ray.on_outline && covering < 2) {
        ASSERT_EQ(covering, ray.count % 2) << "case " << i;
      }
    }
  }
}

TEST(Tessellate, AHoleStaysOne) {
  const auto triangles = tessellate({ring_of_corners({{0, 0}, {9, 0}, {9, 9}, {0, 9}}),
                                     ring_of_corners({{3, 3}, {3, 6}, {6, 6}, {6, 3}})});
  Exact twice(0);
  for (const auto& t : triangles) twice += area_of(t);
  EXPECT_EQ(twice, Exact(2 * (81 - 9)));
}

}  // namespace
}  // namespace fathom::pipeline
