// Where rings of one side touch or cross, against a look at all pairs of edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/weiler_atherton/contacts.h"
#include "fathom/clipping/weiler_atherton/side_contacts.h"
#include "fathom/failures/errors.h"
#include "tests/clipping/print.h"
#include "tests/clipping/random_polygons.h"
#include "tests/effort.h"
#include "tests/scratch_folder.h"

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
  for (int i = 0; i < 4000 / checks::effort; ++i) {
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
  EXPECT_GT(crossing, 500U / checks::effort);
  EXPECT_GT(touching, 300U / checks::effort);
}

/// Triangles in one corner of a square, each with its legs on those of the next: the legs of the
/// i-th have i − 1 corners of others within each.
NumberedCorners<double> many_touches(int triangles, int teeth) {
  Rings<double> rings;
  for (int i = 1; i <= triangles; ++i) {
    const double x = i;
    rings.push_back({{0, 0}, {x, 0}, {0, x}});
  }
  // A square far away, whose lower edge is touched by teeth.
  const double width = 2 * teeth + 2;
  rings.push_back({{1000, 0}, {1000 + width, 0}, {1000 + width, 9}, {1000, 9}});
  Ring<double> saw;
  for (int i = 1; i <= 2 * teeth; ++i) saw.push_back({1000.0 + i, i % 2 == 0 ? 0.0 : -1.0});
  saw.push_back({1000 + width, -9});
  rings.push_back(saw);
  return numbered(rings);
}

TEST(Touches, AsManyAsTheLimitAreEntered) {
  const auto entered = [](const NumberedCorners<double>& corners) {
    const auto touched = enter_touches(corners.rings, PointOrder(corners.points));
    std::size_t before = 0, after = 0;
    for (const NumberedRing& ring : corners.rings) before += ring.size();
    for (const NumberedRing& ring : std::get<NumberedRings>(touched)) after += ring.size();
    return after - before;
  };
  // 512 · 511 of the triangles.
  EXPECT_EQ(entered(many_touches(512, 512)), most_contacts);
  EXPECT_EQ(message_of<InputError>([&] { entered(many_touches(512, 513)); }),
            "the rings meet in more than 262144 points");
}

}  // namespace
}  // namespace fathom::clipping::test
