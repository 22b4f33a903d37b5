// docs/sources.md, scan conversion: errors of lines, polygons and triangles, 1 to 13, 33 and 34.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "fathom/pipeline/scan/area_fill.h"
#include "fathom/pipeline/scan/edge_function.h"
#include "fathom/pipeline/scan/line-inl.h"
#include "tests/pipeline/errata_cases.h"

namespace fathom::pipeline {
namespace {

using Pixels = std::vector<Pixel>;

Pixels right_line(const LineEnds& ends) {
  Pixels pixels;
  bresenham_line(ends, {}, [&](const Pixel& p, std::int64_t) { pixels.push_back(p); });
  return pixels;
}

TEST(Errata, E01_SignOfTheMidpointsDifference) {
  // Taken literally, F(M) = 2dy − dx with "F > 0: north-east" and updates by F's own differences,
  // d −= 2dy for east and d += 2(dx − dy) for north-east, climbs the diagonal.
  const int dx = 8, dy = 3;
  Pixels wrong{{0, 0}};
  for (int x = 0, y = 0, F = -(2 * dy - dx); x < dx;) {
    const bool north_east = F > 0;
    F += north_east ? 2 * (dx - dy) : -2 * dy;
    wrong.push_back({++x, y += north_east});
  }
  EXPECT_EQ(wrong.back(), (Pixel{8, 8}));
  EXPECT_EQ(right_line({0, 0, 8, 3}).back(), (Pixel{8, 3}));
}

TEST(Errata, E02_IntegerDivisionOfTheSlope) {
  Pixels wrong;
  const int m = 3 / 8;
  for (int x = 0; x <= 8; ++x) wrong.push_back({x, m * x});
  EXPECT_EQ(wrong.back().y, 0);  // a horizontal line
  EXPECT_NE(wrong, right_line({0, 0, 8, 3}));
}

TEST(Errata, E03_RoundingHalfToEven) {
  Pixels wrong;
  for (int x = 0; x <= 4; ++x)
    wrong.push_back({x, static_cast<std::int64_t>(std::nearbyint(x / 2.0))});
  EXPECT_EQ(wrong, (Pixels{{0, 0}, {1, 0}, {2, 1}, {3, 2}, {4, 2}}));
  EXPECT_EQ(right_line({0, 0, 4, 2}), (Pixels{{0, 0}, {1, 1}, {2, 1}, {3, 2}, {4, 2}}));
}

/// The sources' Bresenham: at a tie it stays, in whatever direction it goes.
Pixels their_bresenham(int x0, int y0, int x1, int y1) {
  int dx = std::abs(x1 - x0), dy = std::abs(y1 - y0);
  const int sx = x0 < x1 ? 1 : -1, sy = y0 < y1 ? 1 : -1;
  const bool steep = dy > dx;
  if (steep) std::swap(dx, dy);
  Pixels pixels;
  int error = 2 * dy - dx;
  for (int i = 0, x = x0, y = y0; i <= dx; ++i) {
    pixels.push_back({x, y});
    if (error > 0) {
      (steep ? x : y) += steep ? sx : sy;
      error -= 2 * dx;
    }
    (steep ? y : x) += steep ? sy : sx;
    error += 2 * dy;
  }
  return pixels;
}

TEST(Errata, E04_TiesByDirection) {
  Pixels there = their_bresenham(0, 0, 4, 2), back = their_bresenham(4, 2, 0, 0);
  std::reverse(back.begin(), back.end());
  EXPECT_NE(there, back);
  Pixels right = right_line({0, 0, 4, 2}), right_back = right_line({4, 2, 0, 0});
  std::reverse(right_back.begin(), right_back.end());
  EXPECT_EQ(right, right_back);
}

TEST(Errata, E05_TheSourcesBresenhamDoesAllOctants) {
  for (const auto& [x, y] :
       {std::pair(9, 0), {9, 9}, {0, 9}, {-9, 9}, {-9, 0}, {-9, -9}, {0, -9}, {9, -9}})
    EXPECT_EQ(their_bresenham(0, 0, x, y), right_line({0, 0, x, y}));  // no ties at 45 degrees
}

/// Binary64 that counts what is done with it.
struct Counted {
  double value = 0;

  Counted() = default;
  explicit Counted(std::int64_t i) : value(static_cast<double>(i)) {}
  static Counted of(double x) {
    Counted result;
    result.value = x;
    return result;
  }
  static inline int additions = 0, divisions = 0;

  Counted operator+(const Counted& o) const { return ++additions, of(value + o.value); }
  Counted operator-(const Counted& o) const { return of(value - o.value); }
  Counted operator*(const Counted& o) const { return of(value * o.value); }
  Counted operator/(const Counted& o) const { return ++divisions, of(value / o.value); }
  Counted& operator+=(const Counted& o) { return *this = *this + o; }
  friend auto operator<=>(const Counted&, const Counted&) = default;
};
std::int64_t floor_of(const Counted& x) {
  return pipeline::floor_of(x.value);
}

TEST(Errata, E05_ALineDividesOnce) {
  const auto counts_of = [](const auto& draw, std::int64_t length) {
    Counted::additions = Counted::divisions = 0;
    draw(LineEnds{0, 0, length, length / 3}, PixelWindow{}, [](const Pixel&, const Counted&) {});
    return std::pair(Counted::additions, Counted::divisions);
  };
  for (const int length : {8, 1000}) {
    EXPECT_EQ(counts_of(dda_line<Counted>, length), std::pair(length + 1, 1));
    EXPECT_EQ(counts_of(explicit_line<Counted>, length), std::pair(length + 1, 1));
  }
}

TEST(Errata, E06_AParabolasParameterCoversHalfOfTheLine) {
  // y = 2x + 4 from (−6, −8) to (6, 16): one pixel in each row, the nearest, at a tie the right
  // one.
  const Pixels line = right_line({-6, -8, 6, 16});
  Pixels nearest;
  for (int y = -8; y <= 16; ++y) {
    nearest.push_back({static_cast<std::int64_t>(std::floor((y - 4) / 2.0 + 0.5)), y});
  }
  EXPECT_EQ(line, nearest);
  // (t² + 1, 2(t² + 1) + 4), drawn from t to t, reaches those with x ≥ 1 and no other.
  std::set<Pixel> wrong;
  for (int t = -8; t < 8; ++t) {
    const auto at = [](int i) { return std::int64_t{i} * i + 1; };
    bresenham_line({at(t), 2 * at(t) + 4, at(t + 1), 2 * at(t + 1) + 4}, {},
                   [&](const Pixel& p, std::int64_t) { wrong.insert(p); });
  }
  for (const Pixel& p : line) EXPECT_EQ(wrong.count(p), p.x >= 1 && p.y >= 6) << p.x << " " << p.y;
}

TEST(Errata, E33_SevenOtherOctants) {
  // A line without ties, and its images by the symmetries of the square: itself and seven others.
  const LineEnds first{0, 0, 9, 4};
  std::set<Pixels> lines;
  for (int i = 0; i < 8; ++i) {
    const auto image = [&](const Pixel& p) {
      const std::int64_t x = i & 1 ? -p.x : p.x, y = i & 2 ? -p.y : p.y;
      return i & 4 ? Pixel{y, x} : Pixel{x, y};
    };
    Pixels expected = right_line(first);
    std::transform(expected.begin(), expected.end(), expected.begin(), image);
    const Pixel end = image({first.x1, first.y1});
    EXPECT_EQ(right_line({0, 0, end.x, end.y}), expected) << i;
    lines.insert(expected);
  }
  EXPECT_EQ(lines.size() - 1, 7u);  // not eight
}

Ring<Exact> ring_of(const std::vector<std::array<int, 2>>& corners) {
  Ring<Exact> ring;
  for (const auto& [x, y] : corners) ring.push_back({Exact(x), Exact(y)});
  return ring;
}

TEST(Errata, E07_ConvexityByDotProducts) {
  const auto square = ring_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  const auto l_shape = ring_of({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}});
  const auto all_dots_zero = [](const Ring<Exact>& ring) {
    for (std::size_t i = 0, n = ring.size(); i < n; ++i) {
      const auto &a = ring[i], &b = ring[(i + 1) % n], &c = ring[(i + 2) % n];
      if ((b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y) != 0) return false;
    }
    return true;
  };
  EXPECT_EQ(all_dots_zero(square), all_dots_zero(l_shape));  // cannot tell them apart
  EXPECT_NE(convexity_of(square).convex, convexity_of(l_shape).convex);
}

TEST(Errata, E08_ALineInsteadOfARay) {
  const auto square = ring_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  auto mirrored = square;
  for (auto& p : mirrored) p.x = -p.x;
  const int right = ray_crossings<Exact>({square}, {Exact(1), Exact(1)}).count;
  const int left = ray_crossings<Exact>({mirrored}, {Exact(-1), Exact(1)}).count;
  EXPECT_EQ((right + left) % 2, 0);  // the line: even for an inside point
  EXPECT_EQ(right % 2, 1);
}

/// Crossings of row 0 of a triangle with a corner on its scan line.
std::size_t crossings_at_corner(bool corner_on_top) {
  const Exact h = Exact(1) / Exact(2);
  const FillPolygon<Exact> polygon{{{Exact(3), h, {}},
                                    {Exact(1), corner_on_top ? Exact(4) : Exact(-4), {}},
                                    {Exact(5), corner_on_top ? Exact(4) : Exact(-4), {}}}};
  std::size_t count = 0;
  fill_polygon<Exact>(polygon, FillRule::even_odd, {}, [&](const auto& line) {
    if (line.y == 0) count = line.crossings.size();
  });
  return count;
}

TEST(Errata, E09_WhichExtremumCountsDependsOnTheDirectionOfY) {
  EXPECT_EQ(crossings_at_corner(true), 2u);   // the top, with y down the least y
  EXPECT_EQ(crossings_at_corner(false), 0u);  // the bottom, the source's "minimum": 2
}

TEST(Errata, E10_TheEdgeFunctionIsNotTheCrossProductStatedBesideIt) {
  // y down: these corners run counter-clockwise as numbers, which is clockwise as seen, then back.
  const std::array<std::array<int, 2>, 3> corners{{{0, 0}, {7, 1}, {2, 6}}};
  for (const bool reversed : {false, true}) {
    std::array<std::array<int, 2>, 3> c = corners;
    if (reversed) std::swap(c[1], c[2]);
    std::array<Point<Exact>, 3> t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = {Exact(c[k][0]), Exact(c[k][1])};
    const auto triangle = edge_functions(t);
    ASSERT_TRUE(triangle);
    EXPECT_EQ(triangle->turned, !reversed);
    const int sign = reversed ? -1 : 1;
    for (int y = -1; y <= 7; ++y) {
      for (int x = -1; x <= 8; ++x) {
        // Of the edge from A to B, opposite C: (B − A) × (P − A), positive inside.
        const auto &a = c[0], &b = c[1];
        const int cross = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
        EXPECT_EQ(triangle->edges[2].at(Exact(x), Exact(y)), Exact(sign * cross));
        const double theirs = their_edge({double(a[0]), double(a[1])}, {double(b[0]), double(b[1])},
                                         {double(x), double(y)});
        EXPECT_EQ(triangle->edges[2].at(Exact(x), Exact(y)), Exact(-sign * theirs));
      }
    }
  }
}

TEST(Errata, E11_LeftEdgesAreNotThoseThatGoUp) {
  // Both windings of one triangle: the left edge goes up in one, down in the other.
  const std::array<Point<Exact>, 3> t{
      {{Exact(0), Exact(0)}, {Exact(4), Exact(2)}, {Exact(0), Exact(4)}}};
  const std::array<Point<Exact>, 3> reversed{t[0], t[2], t[1]};
  // The edge on x = 0 is opposite (4, 2): B, or C in the reversed one.
  EXPECT_TRUE(edge_functions(t)->edges[1].left_or_top);
  EXPECT_TRUE(edge_functions(reversed)->edges[2].left_or_top);
}

TEST(Errata, E12_GreaterOrEqualIsNoTopLeftRule) {
  const std::array<double, 2> a{50, 20}, b{200, 150}, c{30, 180};
  int wrong = 0;
  std::size_t right = 0;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      const std::array<double, 2> p{x + 0.5, y + 0.5};
      wrong += their_edge(b, c, p) >= 0 && their_edge(c, a, p) >= 0 && their_edge(a, b, p) >= 0;
    }
  EXPECT_EQ(wrong, 0);  // exercise 2's triangle winds the other way: no fragment at all
  rasterize_triangle<Exact>(
      {{{Exact(50), Exact(20)}, {Exact(200), Exact(150)}, {Exact(30), Exact(180)}}}, {},
      [&](const auto&) { ++right; });
  EXPECT_NEAR(static_cast<double>(right), 13300, 600);  // the area; less than its outline off
  // And two triangles that share an edge both take a sample on it.
  const std::array<double, 2> o{0, 0}, u{4, 0}, d{0, 4}, e{4, 4}, on{2, 2};
  const auto takes = [&](const auto& p, const auto& q, const auto& r) {
    return their_edge(q, r, on) >= 0 && their_edge(r, p, on) >= 0 && their_edge(p, q, on) >= 0;
  };
  EXPECT_TRUE(takes(o, d, u) && takes(u, d, e));
}

TEST(Errata, E13_ATinyAreaIsNoZero) {
  const double s = 1e-6;
  EXPECT_LT(std::abs(their_edge({0.5, 0.5 - s}, {0.5 + s, 0.5 + s}, {0.5 - s, 0.5 + s})), 1e-10);
  std::size_t covered = 0;
  rasterize_triangle<Exact>({{{Exact(0.5), Exact(0.5 - s)},
                              {Exact(0.5 + s), Exact(0.5 + s)},
                              {Exact(0.5 - s), Exact(0.5 + s)}}},
                            {}, [&](const auto&) { ++covered; });
  EXPECT_EQ(covered, 1u);
}

/// Values at pixels, by edges and then scan lines: the mixed differences, which are 0 for what is
/// linear in x and y.
std::set<Exact> mixed_differences(const std::vector<FillCorner<Exact>>& corners) {
  std::map<Pixel, Exact> values;
  fill_polygon<Exact>({corners}, FillRule::even_odd, {}, [&](const ScanLine<Exact>& line) {
    for (const auto& span : line.spans) {
      std::int64_t x = span.pixels.x_begin;
      for (const auto& value : values_along(span)) values[{x++, span.pixels.y}] = value[0];
    }
  });
  std::set<Exact> differences;
  for (const auto& [p, value] : values) {
    const auto right = values.find({p.x + 1, p.y}), below = values.find({p.x, p.y + 1});
    const auto both = values.find({p.x + 1, p.y + 1});
    if (right == values.end() || below == values.end() || both == values.end()) continue;
    differences.insert(Exact(both->second - right->second - below->second + value));
  }
  return differences;
}

TEST(Errata, E34_OnATriangleInterpolationIsLinear) {
  const auto corner = [](int x, int y, int value) {
    return FillCorner<Exact>{Exact(x), Exact(y), {Exact(value)}};
  };
  // On a triangle nothing is left of "bilinear", whichever way it is turned.
  EXPECT_EQ(mixed_differences({corner(0, 0, 1), corner(9, 2, 0), corner(3, 8, 5)}),
            (std::set<Exact>{Exact(0)}));
  EXPECT_EQ(mixed_differences({corner(0, 8, 1), corner(2, 0, 0), corner(8, 6, 5)}),
            (std::set<Exact>{Exact(0)}));
  // On a square it is: 1 at one corner and 0 at the others is x·y.
  EXPECT_EQ(mixed_differences({corner(0, 0, 0), corner(4, 0, 0), corner(4, 4, 1), corner(0, 4, 0)}),
            (std::set<Exact>{Exact(1) / Exact(16)}));
}

}  // namespace
}  // namespace fathom::pipeline
