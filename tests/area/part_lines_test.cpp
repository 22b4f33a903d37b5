// Lines of a part, each once, and the order in which they cross, against rational numbers; certain
// sides against exact ones.
#include "fathom/area/plane/part_lines.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "fathom/area/plane/certain_sides.h"

namespace fathom::area {
namespace {

using Q = mpq_class;

struct Coefficients {
  double a, b, c;
};

/// τ where a line crosses e, in the direction (e_v, −e_u), from the foot of the origin.
Q place(const Coefficients& e, const Coefficients& m) {
  const Q scale = -Q(e.c) / (Q(e.a) * e.a + Q(e.b) * e.b);
  const Q value = Q(m.a) * e.a * scale + Q(m.b) * e.b * scale + m.c;
  return value / (Q(e.a) * m.b - Q(e.b) * m.a);
}

TEST(PartLines, LinesOfTheSamePointsAreOne) {
  PartLines lines;
  const OrientedLine first = lines.add({1.0, 2.0, -3.0});
  EXPECT_EQ(lines.add({3.0, 6.0, -9.0}), first);
  EXPECT_EQ(lines.add({-0.5, -1.0, 1.5}), (OrientedLine{first.line, true}));
  EXPECT_NE(lines.add({1.0, 2.0, -3.0000000000000004}).line, first.line);
  EXPECT_NE(lines.add({1.0000000000000002, 2.0, -3.0}).line, first.line);
  EXPECT_EQ(lines.size(), 3U);
}

TEST(PartLines, AnEdgeIsKnownByItsEndsFromBothSides) {
  PartLines lines;
  int asked = 0;
  const auto upwards = [&] {
    ++asked;
    return ExactVector3{-1.0, 0.0, 1.0};
  };
  const OrientedLine there = lines.through(7, 9, upwards), back = lines.through(9, 7, upwards);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(there, (OrientedLine{0, false}));
  EXPECT_EQ(back, (OrientedLine{0, true}));
  PartLines other;
  const auto downwards = [] { return ExactVector3{1.0, 0.0, -1.0}; };
  const OrientedLine first = other.through(9, 7, downwards);
  EXPECT_EQ(other.through(7, 9, downwards), (OrientedLine{first.line, !first.reversed}));
}

TEST(PartLines, LinesThroughAKnownVertexMeetThereWithoutArithmetic) {
  PartLines lines;
  // Through (1/3, 1/7), of which the bounds cannot be certain.
  const auto through = [&](double a, double b, std::uint32_t vertex) {
    return lines.add({21 * a, 21 * b, -(7 * a + 3 * b)}, std::array{vertex});
  };
  const std::uint32_t a = through(1, 2, 5).line, b = through(2, -1, 5).line,
                      c = through(3, 7, 5).line, d = through(5, -3, 6).line;
  const std::uint64_t before = lines.decisions().exact;
  EXPECT_EQ(lines.determinant(a, b, c), Sign::zero);
  EXPECT_EQ(lines.decisions().exact, before);
  EXPECT_EQ(lines.determinant(a, b, d), Sign::zero);
  EXPECT_GT(lines.decisions().exact, before);
}

TEST(LineOrder, IsThatOfThePlaces) {
  std::mt19937_64 random(1931);
  const auto number = [&] {
    const double x = static_cast<double>(random() % 17) - 8;
    return random() % 4 == 0 ? std::nextafter(x, random() % 2 ? 9 : -9) : x;
  };
  int ties = 0;
  for (int round = 0; round < 200; ++round) {
    PartLines lines;
    std::vector<Coefficients> all;
    while (all.size() < 12) {
      const Coefficients l{number(), number(), number()};
      if (l.a == 0 && l.b == 0) continue;
      if (const OrientedLine added = lines.add({l.a, l.b, l.c}); added.line == all.size()) {
        all.push_back(l);
      }
    }
    for (std::uint32_t e = 0; e < all.size(); ++e) {
      const LineOrder order(lines, e);
      for (std::uint32_t m = 0; m < all.size(); ++m) {
        for (std::uint32_t n = 0; n < all.size(); ++n) {
          if (lines.turn(e, m) == Sign::zero || lines.turn(e, n) == Sign::zero) continue;
          const int expected = cmp(place(all[e], all[m]), place(all[e], all[n]));
          const auto found = order.rank(m) <=> order.rank(n);
          ASSERT_EQ(found < 0, expected < 0) << round << ' ' << e << ' ' << m << ' ' << n;
          ASSERT_EQ(found > 0, expected > 0) << round << ' ' << e << ' ' << m << ' ' << n;
          ties += m != n && expected == 0;
        }
      }
    }
  }
  EXPECT_GT(ties, 100);
}

/// Of places outside the square, only the side on which they are.
TEST(LineOrder, WithinAPolygonIsThatOfThePlacesMovedToItsEnds) {
  std::mt19937_64 random(8);
  const auto number = [&] { return static_cast<double>(random() % 33) / 4 - 4; };
  int inside = 0;
  for (int round = 0; round < 300; ++round) {
    PartLines lines;
    std::vector<Coefficients> all{{1, 0, 0}, {0, 1, 0}, {-1, 0, 2}, {0, -1, 3}};
    LinePolygon square;
    for (const Coefficients& l : all) square.push_back(lines.add({l.a, l.b, l.c}));
    while (all.size() < 12) {
      const Coefficients l{number(), number(), number()};
      if (l.a == 0 && l.b == 0) continue;
      if (lines.add({l.a, l.b, l.c}).line == all.size()) all.push_back(l);
    }
    for (std::uint32_t e = 4; e < all.size(); ++e) {
      std::optional<Q> first, last;
      std::uint32_t from = 0, to = 0xFFFFFFFF;
      const LineOrder order(lines, e, square);
      for (std::uint32_t side = 0; side < 4; ++side) {
        if (lines.turn(e, side) == Sign::zero) continue;
        const Q at = place(all[e], all[side]);
        if (lines.turn(e, side) == Sign::negative) {
          if (!first || at > *first) first = at;
          from = std::max(from, order.rank(side));
        } else {
          if (!last || at < *last) last = at;
          to = std::min(to, order.rank(side));
        }
      }
      if (!(*first < *last)) continue;
      ASSERT_LT(from, to);
      for (std::uint32_t m = 0; m < all.size(); ++m) {
        for (std::uint32_t n = 0; n < all.size(); ++n) {
          if (lines.turn(e, m) == Sign::zero || lines.turn(e, n) == Sign::zero) continue;
          const int expected = cmp(std::clamp(place(all[e], all[m]), *first, *last),
                                   std::clamp(place(all[e], all[n]), *first, *last));
          const auto found =
              std::clamp(order.rank(m), from, to) <=> std::clamp(order.rank(n), from, to);
          ASSERT_EQ(found < 0, expected < 0) << round << ' ' << e << ' ' << m << ' ' << n;
          ++inside;
        }
      }
    }
  }
  EXPECT_GT(inside, 10'000);
}

TEST(CertainSides, AreThoseOfEveryPointWithinTheErrors) {
  std::mt19937_64 random(77);
  const auto number = [&](double size) {
    return size * (static_cast<double>(random() % 4097) / 2048 - 1);
  };
  int certain = 0, unknown = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double error = random() % 3 == 0 ? 0 : std::ldexp(1, -static_cast<int>(random() % 50));
    BoundedPoint p[3];
    Q u[3], v[3];
    for (int k = 0; k < 3; ++k) {
      p[k] = {number(4), number(4), error};
      // Nearly on a line.
      if (k == 2 && random() % 2) {
        const double t = number(2);
        p[2].u = p[0].u + t * (p[1].u - p[0].u);
        p[2].v = p[0].v + t * (p[1].v - p[0].v) + number(1e-15);
      }
      u[k] = Q(p[k].u) + Q(number(1)) * error;
      v[k] = Q(p[k].v) + Q(number(1)) * error;
    }
    const int side = certain_side(p[0], p[1], p[2]);
    const int exact = sgn(Q((u[1] - u[0]) * (v[2] - v[0]) - (v[1] - v[0]) * (u[2] - u[0])));
    if (side == 0) {
      ++unknown;
    } else {
      ++certain;
      ASSERT_EQ(side, exact) << i;
    }
  }
  EXPECT_GT(certain, 40'000);
  EXPECT_GT(unknown, 10'000);
}

TEST(CertainSides, SegmentsAndBoxesMissAPartOnlyForCertain) {
  const PlanePart part{1, 1, 2, 3};
  EXPECT_TRUE(misses(part, {0, 0, 0.25}, {0.5, 9, 0.25}));
  EXPECT_FALSE(misses(part, {0, 0, 0.5}, {0.5, 9, 0.5}));
  EXPECT_TRUE(misses(part, {0, 4, 0}, {2, 3.5, 0}));
  EXPECT_FALSE(misses(part, {0, 3, 0}, {3, 2, 0}));
  // Past a corner.
  EXPECT_TRUE(misses(part, {0, 1.75, 0}, {1.75, 0, 0}));
  EXPECT_FALSE(misses(part, {0, 1.75, 0.125}, {1.75, 0, 0.125}));
  EXPECT_TRUE(PlaneBox({1.5, 1.5, 0.25}).is_inside(part));
  EXPECT_FALSE(PlaneBox({1.5, 1.5, 0.5}).is_inside(part));
  EXPECT_FALSE(PlaneBox({1.5, 1.5, 0}, {1.5, 3, 0}).is_inside(part));
}

}  // namespace
}  // namespace fathom::area
