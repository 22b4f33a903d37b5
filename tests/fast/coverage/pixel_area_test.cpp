// Areas within a pixel by binary64: their bounds hold, and are not much wider than they need be.
#include "fathom/fast/coverage/pixel_area.h"

#include <gtest/gtest.h>

#include <random>

#include "fathom/fast/vertices/vertex.h"
#include "tests/effort.h"
#include "tests/fast/coverage/square_triangles.h"
#include "tests/oracle/clipped_polygon.h"

namespace fathom {
namespace {

using namespace fast;
using namespace checks;
using oracle::Q;

Interval area_of_union(const std::vector<SquareTriangle>& triangles) {
  PixelUnion pixel;
  pixel.clear();
  for (const SquareTriangle& t : triangles) pixel.add(t, 0);
  return pixel.area();
}

Interval area_between_edges(const std::vector<SquareTriangle>& triangles) {
  PixelWinding pixel;
  pixel.clear();
  for (const SquareTriangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) pixel.add(t[k], t[(k + 1) % 3], 0);
  }
  return pixel.area([&](const SquarePoint& s) {
    int number = 0;
    for (const SquareTriangle& t : triangles) {
      bool inside = true, outside = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const double e = cross({s, t[k], t[(k + 1) % 3]});
        inside = inside && e > 0x1p-48;
        outside = outside || e < -0x1p-48;
      }
      if (!inside && !outside) return -1;
      if (inside) ++number;
    }
    return number;
  });
}

void expect_contains(const Interval& area, const Q& exact) {
  EXPECT_LE(Q(area.lower), exact);
  EXPECT_GE(Q(area.upper), exact);
}

TEST(PixelArea, IntervalsContainTheExactArea) {
  std::mt19937_64 random(20);
  int settled = 0, cases = 0;
  for (int i = 0; i < 3000 / checks::effort && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const auto triangles =
        random_triangles(random, 1 + static_cast<std::size_t>(i) % 9, i % 2 == 0);
    const Q exact = exact_area(triangles);
    const Interval by_union = area_of_union(triangles), by_edges = area_between_edges(triangles);
    expect_contains(by_union, exact);
    expect_contains(by_edges, exact);
    // Nothing here is larger than 2, and there are at most 54 breaks at corners and a crossing of
    // each two of 27 edges and of each with two sides: 10·20·16·2u + 32u·459 < 2⁻³⁸.
    EXPECT_LE(by_union.upper - by_union.lower, 0x1p-37);
    cases += 1;
    settled += by_edges.upper - by_edges.lower < 0x1p-36;
  }
  // A point of which the number is not certain is hardly ever met three times.
  EXPECT_GT(settled, cases * 9 / 10);
}

/// A triangle that is there a thousand times, and one beside it that has an edge in common with
/// all.
TEST(PixelArea, EdgesInOnePlaceAreOne) {
  const SquareTriangle t{{{0.125, 0.25}, {0.75, 0.25}, {0.25, 0.875}}};
  const SquareTriangle beside{{{0.75, 0.25}, {0.875, 1.5}, {0.25, 0.875}}};
  PixelWinding pixel;
  pixel.clear();
  const auto add = [&](const SquareTriangle& its, int times) {
    for (std::size_t k = 0; k < 3; ++k) pixel.add(its[k], its[(k + 1) % 3], 0, times);
  };
  for (int i = 0; i < 999; ++i) add(t, 1);
  EXPECT_EQ(pixel.size(), 3U);
  add(t, 1);
  add(beside, 1);
  EXPECT_EQ(pixel.size(), 5U);
  const auto is_in = [](const SquareTriangle& its, const SquarePoint& s) {
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) inside = inside && cross({s, its[k], its[(k + 1) % 3]}) > 0;
    return inside;
  };
  const Interval area = pixel.area(
      [&](const SquarePoint& s) { return (is_in(t, s) ? 1000 : 0) + (is_in(beside, s) ? 1 : 0); });
  expect_contains(area, exact_area({t, beside}));
  EXPECT_LT(area.upper - area.lower, 0x1p-40);
}

TEST(PixelArea, OfNothingIsNothing) {
  PixelUnion pixel;
  pixel.clear();
  EXPECT_EQ(pixel.area().lower, 0);
  EXPECT_LT(pixel.area().upper, 0x1p-40);
  pixel.add(SquareTriangle{{{2, 0}, {3, 0}, {2, 1}}}, 0);
  EXPECT_EQ(pixel.area().lower, 0);
  EXPECT_LT(pixel.area().upper, 0x1p-40);
}

/// A level edge alone divides the square: no other edge has an end at its height.
TEST(PixelArea, ALevelEdgeDividesTheSquare) {
  PixelWinding pixel;
  pixel.clear();
  pixel.add({-5, 0.25}, {7, 0.25}, 0);
  const Interval area = pixel.area([](const SquarePoint& s) { return s.y > 0.25 ? 1 : 0; });
  EXPECT_LE(area.lower, 0.75);
  EXPECT_GE(area.upper, 0.75);
  EXPECT_LT(area.upper - area.lower, 0x1p-40);
}

TEST(PixelArea, ASquareIsClippedByLinesWithinItsBound) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 3000 / checks::effort && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    ClippedSquare square;
    oracle::Polygon exact{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int k = 0; k < 1 + i % 5; ++k) {
      const double a = number(random), b = number(random), c = number(random) / 2 + 0.2;
      // Two products and two sums of numbers below 2.7.
      square.clip({a, b, c, 8 * unit_roundoff<double> * 2.7});
      exact = oracle::clipped(exact, Q(a), Q(b), Q(c));
    }
    PixelUnion pixel;
    pixel.clear();
    pixel.add(square.corners(), square.area_error());
    const Interval area = pixel.area();
    expect_contains(area, Q(oracle::twice_area(exact) / 2));
    EXPECT_LT(square.area_error(), 0x1p-30);
  }
}

}  // namespace
}  // namespace fathom
