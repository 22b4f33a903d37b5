// Where rings of one side touch or cross, against a look at all pairs of edges.
#include "fathom/clipping/touches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "fathom/clipping/contacts.h"
#include "fathom/clipping/exact_kernel.h"
#include "tests/clipping/print.h"
#include "tests/clipping/random_polygons.h"
#include "tests/effort.h"

namespace fathom::clipping::test {
namespace {

using P = Point2<Rational>;

Segment2<Rational> edge(const Ring<Rational>& ring, std::size_t i) {
  return {ring[i], ring[(i + 1) % ring.size()]};
}

bool is_within(const P& p, const Segment2<Rational>& s) {
  return !(p == s.start) && !(p == s.end);
}

/// What all pairs of edges of different rings come to.
struct Slowly {
  bool cross = false;  ///< within both
  std::vector<std::set<P>> corners;
};

Slowly look_at_all_pairs(const Rings<Rational>& rings) {
  Slowly slowly;
  for (const Ring<Rational>& ring : rings) slowly.corners.emplace_back(ring.begin(), ring.end());
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t q = 0; q < r; ++q)
      for (std::size_t i = 0; i < rings[r].size(); ++i)
        for (std::size_t k = 0; k < rings[q].size(); ++k) {
          const auto a = edge(rings[r], i), b = edge(rings[q], k);
          for (const P& p : contacts(a, b)) {
            slowly.cross = slowly.cross || (is_within(p, a) && is_within(p, b));
            slowly.corners[r].insert(p);
            slowly.corners[q].insert(p);
          }
        }
  return slowly;
}

TEST(Touches, OnPaper) {
  // A corner on an edge, an edge along a part of another, and two corners in one point.
  const Rings<Rational> rings{{{0, 0}, {6, 0}, {6, 6}, {0, 6}},
                              {{0, 3}, {2, 2}, {2, 4}},
                              {{6, 1}, {8, 1}, {8, 4}, {6, 4}},
                              {{8, 4}, {9, 4}, {9, 5}}};
  const auto corners = numbered(rings);
  const auto touching = enter_touches(corners.rings, PointOrder(corners.points));
  const NumberedRings& entered = std::get<NumberedRings>(touching);
  EXPECT_EQ(ring_of(entered[0], corners.points),
            (Ring<Rational>{{0, 0}, {6, 0}, {6, 1}, {6, 4}, {6, 6}, {0, 6}, {0, 3}}));
  for (std::size_t r = 1; r < rings.size(); ++r)
    EXPECT_EQ(ring_of(entered[r], corners.points), rings[r]);
}

TEST(Touches, AreThoseOfAllPairs) {
  PolygonMaker maker(77);
  std::size_t crossing = 0, touching = 0;
  for (int i = 0; i < 4000 / testing::effort; ++i) {
    // Every other one does not cross within edges.
    const auto crosses = [&](const Rings<double>& rings) {
      return i % 2 == 0 && look_at_all_pairs(to_exact(rings)).cross;
    };
    const Rings<Rational> rings = to_exact(maker.polygon(2 + i % 6, 4 + i % 7, crosses));
    const Slowly slowly = look_at_all_pairs(rings);
    const auto corners = numbered(rings);
    const auto result = enter_touches(corners.rings, PointOrder(corners.points));
    const auto* entered = std::get_if<NumberedRings>(&result);
    ASSERT_EQ(entered == nullptr, slowly.cross) << "polygon " << i;
    if (entered == nullptr) {
      ++crossing;
      continue;
    }
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const Ring<Rational> ring = ring_of((*entered)[r], corners.points);
      ASSERT_EQ(std::set<P>(ring.begin(), ring.end()), slowly.corners[r]) << "polygon " << i;
      ASSERT_EQ(ring.size(), slowly.corners[r].size());
      touching += ring.size() - rings[r].size();
      // Between two corners of the old ring the new ones lie in order: the area is the same.
      EXPECT_EQ(direction_of((*entered)[r], PointOrder(corners.points)),
                direction_of(corners.rings[r], PointOrder(corners.points)));
    }
  }
  EXPECT_GT(crossing, 500U / testing::effort);
  EXPECT_GT(touching, 300U / testing::effort);
}

}  // namespace
}  // namespace fathom::clipping::test
