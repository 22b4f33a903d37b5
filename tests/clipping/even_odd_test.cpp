// What lies beside an edge, against a count of crossings without any index.
#include "fathom/clipping/even_odd.h"

#include <gtest/gtest.h>

#include <random>

#include "fathom/clipping/exact_kernel.h"

namespace fathom::clipping {
namespace {

using P = Point2<Rational>;

/// Whether a point that lies on no edge is inside: crossings of the ray towards +x.
bool is_inside(const Rings<Rational>& rings, const P& point) {
  bool inside = false;
  for (const Ring<Rational>& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const P &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if ((a.y <= point.y) == (b.y <= point.y)) continue;
      const Rational x = a.x + (point.y - a.y) * (b.x - a.x) / (b.y - a.y);
      if (x > point.x) inside = !inside;
    }
  }
  return inside;
}

/// The points a little left and right of the middle of an edge, nearer than anything else is.
Beside beside_slowly(const Rings<Rational>& rings, const P& a, const P& b) {
  const Rational little(1, 1000000);
  const P middle{(a.x + b.x) / Rational(2), (a.y + b.y) / Rational(2)};
  const Rational dx = (b.x - a.x) * little, dy = (b.y - a.y) * little;
  return {is_inside(rings, {middle.x - dy, middle.y + dx}),
          is_inside(rings, {middle.x + dy, middle.y - dx})};
}

TEST(EvenOdd, ASquareWithAHoleOnPaper) {
  const Rings<Rational> rings{{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {{2, 2}, {2, 4}, {4, 4}, {4, 2}}};
  const EvenOdd<Rational> region(rings);
  EXPECT_EQ(region.beside({0, 0}, {6, 0}), (Beside{true, false}));
  EXPECT_EQ(region.beside({6, 0}, {0, 0}), (Beside{false, true}));
  EXPECT_EQ(region.beside({2, 2}, {2, 4}), (Beside{true, false}));  // the hole is on the right
  EXPECT_EQ(region.beside({1, 1}, {1, 5}), (Beside{true, true}));
  EXPECT_EQ(region.beside({2, 3}, {4, 3}), (Beside{false, false}));
  EXPECT_EQ(region.beside({7, 0}, {7, 6}), (Beside{false, false}));
}

TEST(EvenOdd, IsTheCountOfCrossings) {
  std::mt19937 random(231);
  const auto number = [&] { return Rational(static_cast<int>(random() % 9)); };
  for (int i = 0; i < 200; ++i) {
    Rings<Rational> rings;
    for (int r = 0; r < 2; ++r) {
      const Rational x = number(), y = number();
      rings.push_back({{x, y}, {x + 3, y}, {x + 3, y + 2}, {x, y + 2}});
    }
    const EvenOdd<Rational> region(rings);
    for (int k = 0; k < 20; ++k) {
      // Ends at halves, a step that no grid line meets in its middle but for its own.
      const P a{number() + Rational(1, 7), number() + Rational(1, 5)};
      const P b{a.x + Rational(1, 3), a.y + (k % 2 == 0 ? Rational(0) : Rational(1, 4))};
      ASSERT_EQ(region.beside(a, b), beside_slowly(rings, a, b));
    }
    for (const Ring<Rational>& ring : rings) {
      // Along a border, where no other ring touches it.
      const P &a = ring[0], &b = ring[1];
      bool touched = false;
      for (const Ring<Rational>& other : rings) {
        if (&other == &ring) continue;
        touched = other[0].x <= b.x && a.x <= other[1].x && other[0].y <= a.y && a.y <= other[2].y;
      }
      if (!touched) {
        ASSERT_EQ(region.beside(a, b), beside_slowly(rings, a, b));
      }
    }
  }
}

}  // namespace
}  // namespace fathom::clipping
