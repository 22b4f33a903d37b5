// Whether rings that touch cross, against what lies on either side of a ring.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/weiler_atherton/side_contacts.h"
#include "tests/clipping/print.h"
#include "tests/clipping/random_polygons.h"
#include "tests/effort.h"

namespace fathom::clipping::test {
namespace {

using P = Point2<Rational>;

/// The rings with their touches, if no two edges cross.
struct Entered {
  std::vector<P> points;
  std::optional<NumberedRings> rings;

  explicit Entered(const Rings<Rational>& all) {
    const auto corners = numbered(all);
    points = corners.points;
    const auto touching = enter_touches(corners.rings, PointOrder(points));
    if (const auto* entered = std::get_if<NumberedRings>(&touching)) rings = *entered;
  }
};

/// The point of the first crossing.
std::optional<P> crossing_of(const Rings<Rational>& all) {
  const Entered entered(all);
  const auto crossing = ring_crossing(entered.rings.value(), PointOrder(entered.points));
  return crossing ? std::optional(entered.points[crossing->point]) : std::nullopt;
}

const Ring<Rational> square{{0, 0}, {6, 0}, {6, 6}, {0, 6}};

TEST(RingCrossings, InCornersAlone) {
  const Ring<Rational> through_corners{{3, 3}, {6, 0}, {9, 3}, {6, 6}};
  EXPECT_EQ(crossing_of({square, through_corners}), (P{6, 0}));
  EXPECT_EQ(crossing_of({{square.rbegin(), square.rend()}, through_corners}), (P{6, 6}));
  // From corner to corner, all inside or all outside.
  EXPECT_EQ(crossing_of({square, {{3, 3}, {6, 0}, {6, 6}}}), std::nullopt);
  EXPECT_EQ(crossing_of({square, {{6, 0}, {9, 3}, {6, 6}, {7, 3}}}), std::nullopt);
}

TEST(RingCrossings, AlongSharedPiecesAlone) {
  // In through a piece of one side, out through a piece of another.
  const Ring<Rational> through_pieces{{3, 3}, {6, 2}, {6, 4}, {9, 9}, {4, 6}, {2, 6}};
  EXPECT_EQ(crossing_of({square, through_pieces}), (P{6, 2}));
  EXPECT_EQ(crossing_of({{square.rbegin(), square.rend()}, through_pieces}), (P{2, 6}));
  EXPECT_EQ(crossing_of({through_pieces, square}), (P{6, 2}));
  // Along the same pieces, all inside.
  EXPECT_EQ(crossing_of({square, {{3, 3}, {6, 2}, {6, 4}, {4, 6}, {2, 6}}}), std::nullopt);
  EXPECT_EQ(crossing_of({square, square}), std::nullopt);
}

TEST(RingCrossings, WhicheverCornersComeFirst) {
  Ring<Rational> one = square, other{{3, 3}, {6, 2}, {6, 4}, {9, 9}, {4, 6}, {2, 6}};
  for (std::size_t i = 0; i < one.size(); ++i) {
    std::rotate(one.begin(), one.begin() + 1, one.end());
    for (std::size_t k = 0; k < other.size(); ++k) {
      std::rotate(other.begin(), other.begin() + 1, other.end());
      EXPECT_TRUE(crossing_of({one, other}));
    }
  }
}

TEST(RingCrossings, ManyRingsAboutAPoint) {
  // Four wedges about a point, in each other and side by side; and one that goes across.
  const Rings<Rational> wedges{{{0, 0}, {9, -9}, {9, 9}},
                               {{0, 0}, {9, -5}, {9, 5}},
                               {{0, 0}, {-9, 9}, {-9, -9}},
                               {{0, 0}, {9, 9}, {-9, 9}}};
  EXPECT_EQ(crossing_of(wedges), std::nullopt);
  Rings<Rational> more = wedges;
  more.push_back({{0, 0}, {8, 0}, {8, -20}});
  EXPECT_FALSE(Entered(more).rings);  // it also crosses within edges
}

/// Whether a point that lies on no edge is inside: crossings of the ray towards +x.
bool is_inside(const NumberedRing& ring, const std::vector<P>& points, const P& point) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const P &a = points[ring[i]], &b = points[following(ring, i)];
    if ((a.y <= point.y) == (b.y <= point.y)) continue;
    const Rational x = a.x + (point.y - a.y) * (b.x - a.x) / (b.y - a.y);
    if (x > point.x) inside = !inside;
  }
  return inside;
}

/// Whether edges of `ring` lie on both sides of `other`.
bool lies_on_both_sides(const NumberedRing& ring, const NumberedRing& other,
                        const std::vector<P>& points) {
  std::set<UndirectedEdge> shared;
  for (std::size_t i = 0; i < other.size(); ++i)
    shared.insert(undirected(other[i], following(other, i)));
  std::set<bool> sides;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (shared.contains(undirected(ring[i], following(ring, i)))) continue;
    const P &a = points[ring[i]], &b = points[following(ring, i)];
    sides.insert(is_inside(other, points, {(a.x + b.x) / Rational(2), (a.y + b.y) / Rational(2)}));
  }
  return sides.size() == 2;
}

TEST(RingCrossings, AreWhereARingLiesOnBothSidesOfAnother) {
  PolygonMaker maker(78);
  std::size_t crossing = 0, touching = 0;
  for (int i = 0; i < 6000 / checks::effort; ++i) {
    const auto crosses = [](const Rings<double>& rings) {
      return !Entered(to_exact(rings)).rings.has_value();
    };
    const Entered entered(to_exact(maker.polygon(2 + i % 4, 4 + i % 6, crosses)));
    const NumberedRings& rings = entered.rings.value();
    bool expected = false;
    for (std::size_t r = 0; r < rings.size(); ++r)
      for (std::size_t q = 0; q < rings.size(); ++q)
        expected = expected || (q != r && lies_on_both_sides(rings[r], rings[q], entered.points));
    const auto found = ring_crossing(rings, PointOrder(entered.points));
    ASSERT_EQ(found.has_value(), expected) << "polygon " << i;
    ++(expected ? crossing : touching);
  }
  EXPECT_GT(crossing, 100U / checks::effort);
  EXPECT_GT(touching, 1000U / checks::effort);
}

}  // namespace
}  // namespace fathom::clipping::test
