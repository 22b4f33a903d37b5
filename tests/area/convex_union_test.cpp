// Areas of unions and differences: on paper, and by inclusion and exclusion of clipped polygons.
#include "fathom/area/convex_union.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/area/lines.h"
#include "tests/effort.h"
#include "tests/oracle/against_oracle.h"

namespace fathom {
namespace {

using namespace area;
using checks::Line;
using checks::Lines;
using oracle::Q;

/// The exact area of a boundary, which the approximate one encloses.
Q checked_area(const Boundary& boundary) {
  const Q exact = checks::rational(exact_area(boundary));
  const Certified<double> approximate = approximate_area(boundary);
  if (std::isfinite(approximate.error)) {
    EXPECT_LE(abs(Q(Q(approximate.value) - exact)), Q(approximate.error));
  }
  EXPECT_EQ(boundary.empty(), sgn(exact) == 0);
  return exact;
}

Q union_of(const std::vector<ConvexPolygon>& polygons) {
  TierCounts counts;
  return checked_area(boundary_of_union(polygons, counts));
}
Q difference_of(const ConvexPolygon& subject, const std::vector<ConvexPolygon>& polygons) {
  TierCounts counts;
  return checked_area(boundary_of_difference(subject, polygons, counts));
}

/// Bounds that are infinite would be true, but everything would be computed exactly, and slowly.
TEST(ConvexUnion, ApproximateAreasAreClose) {
  Lines lines;
  TierCounts counts;
  const ConvexPolygon squares[] = {lines.rectangle(0, 0, 2, 2).ours};
  EXPECT_EQ(approximate_area({}).value, 0);
  EXPECT_EQ(approximate_area({}).error, 0);
  EXPECT_LT(approximate_area(boundary_of_union(squares, counts)).error, 1e-12);
}

TEST(ConvexUnion, SquaresOnPaper) {
  Lines lines;
  const auto square = [&](double left, double low, double side) {
    return lines.rectangle(left, low, left + side, low + side).ours;
  };
  const ConvexPolygon a = square(0, 0, 2);
  EXPECT_EQ(union_of({}), 0);
  EXPECT_EQ(union_of({a}), 4);
  EXPECT_EQ(union_of({a, a}), 4);                  // equal, the same edges
  EXPECT_EQ(union_of({a, square(0, 0, 2)}), 4);    // equal, other edges
  EXPECT_EQ(union_of({a, square(1, 1, 2)}), 7);    // overlapping
  EXPECT_EQ(union_of({a, square(2, 0, 2)}), 8);    // with a common edge
  EXPECT_EQ(union_of({a, square(2, 2, 2)}), 8);    // touching in a corner
  EXPECT_EQ(union_of({a, square(0.5, 0, 1)}), 4);  // inside, with a part of an edge
  EXPECT_EQ(union_of({a, square(5, 5, 1)}), 5);    // apart
  EXPECT_EQ(difference_of(a, {}), 4);
  EXPECT_EQ(difference_of(a, {a}), 0);
  EXPECT_EQ(difference_of(a, {square(0.5, 0.5, 1)}), 3);  // a hole
  EXPECT_EQ(difference_of(a, {square(1, 1, 2)}), 3);
  EXPECT_EQ(difference_of(a, {square(2, 0, 2)}), 4);
  EXPECT_EQ(difference_of(a, {square(-1, -1, 2), square(1, 1, 2)}), 2);
  // Four around a gap.
  EXPECT_EQ(union_of({lines.rectangle(0, 0, 3, 1).ours, lines.rectangle(2, 0, 3, 3).ours,
                      lines.rectangle(0, 2, 3, 3).ours, lines.rectangle(0, 0, 1, 3).ours}),
            8);
}

/// Half-planes, each with the polygon that they cut out of a rectangle.
struct Cut {
  std::vector<Line> cuts;
  std::optional<Lines::Both> polygon;
};

Cut random_cut(Lines& lines, std::mt19937_64& random, TierCounts& counts) {
  Cut result;
  Lines::Both polygon = lines.rectangle(-2, -2, 2, 2);
  for (int k = 0; k < 3; ++k) {
    result.cuts.push_back(checks::random_line(random));
    if (!lines.clip(polygon, result.cuts.back(), counts)) return result;
  }
  result.polygon = std::move(polygon);
  return result;
}

/// What the cuts of `other` leave of a polygon, in rational numbers.
oracle::Polygon common(oracle::Polygon polygon, const Cut& other) {
  for (const Line& l : other.cuts) polygon = oracle::clipped(polygon, Q(l.a), Q(l.b), Q(l.c));
  return polygon;
}

TEST(ConvexUnion, IsInclusionAndExclusion) {
  std::mt19937_64 random(141);
  TierCounts counts;
  int triples = 0, overlaps = 0;
  for (int i = 0; i < 3000 / checks::effort; ++i) {
    Lines lines;
    const Cut a = random_cut(lines, random, counts), b = random_cut(lines, random, counts),
              c = random_cut(lines, random, counts);
    if (!a.polygon || !b.polygon || !c.polygon) continue;
    ++triples;
    const oracle::Polygon ab = common(a.polygon->exact, b), ac = common(a.polygon->exact, c),
                          bc = common(b.polygon->exact, c), abc = common(ab, c);
    const auto area = [](const oracle::Polygon& p) { return checks::area_of(p); };
    const Q A = area(a.polygon->exact), B = area(b.polygon->exact), C = area(c.polygon->exact);
    overlaps += sgn(area(abc)) > 0;
    ASSERT_EQ(union_of({a.polygon->ours, b.polygon->ours}), A + B - area(ab));
    ASSERT_EQ(union_of({a.polygon->ours, b.polygon->ours, c.polygon->ours}),
              A + B + C - area(ab) - area(ac) - area(bc) + area(abc));
    ASSERT_EQ(difference_of(a.polygon->ours, {b.polygon->ours}), A - area(ab));
    ASSERT_EQ(difference_of(a.polygon->ours, {b.polygon->ours, c.polygon->ours}),
              A - area(ab) - area(ac) + area(abc));
  }
  EXPECT_GT(triples, 500 / checks::effort);
  EXPECT_GT(overlaps, 100 / checks::effort);
}

}  // namespace
}  // namespace fathom
