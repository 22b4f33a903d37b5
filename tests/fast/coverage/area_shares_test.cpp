// The bounds of areas within a pixel from both sides: never violated against rational numbers, and
// not looser than a stated factor.
#include <gtest/gtest.h>

#include <algorithm>

#include "fathom/fast/coverage/pixel_area.h"
#include "fathom/fast/coverage/square_edges.h"
#include "tests/effort.h"
#include "tests/fast/coverage/square_triangles.h"
#include "tests/numeric/error_shares.h"
#include "tests/numeric/random_numbers.h"
#include "tests/oracle/clipped_polygon.h"

namespace fathom {
namespace {

using namespace fast;
using namespace checks;
using oracle::Polygon;
using oracle::Q;

Polygon unit_square() {
  return {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
}

/// To the left of the line from p to q, y downwards: where a triangle of positive area lies.
Polygon beside_line(const Polygon& polygon, const oracle::Point& p, const oracle::Point& q) {
  const Q dx = q[0] - p[0], dy = q[1] - p[1];
  return oracle::clipped(polygon, Q(-dy), dx, Q(dy * p[0] - dx * p[1]));
}

Ratio area_of(const Polygon& polygon) {
  const Q area = oracle::twice_area(polygon) / 2;
  return exactly(area.get_mpq_t());
}

/// Where an interval ends at the least or greatest area that there is, its middle says nothing.
void add_interval(const Interval& area, const Ratio& exact, Share& share) {
  EXPECT_FALSE(exact < Ratio(area.lower));
  EXPECT_FALSE(Ratio(area.upper) < exact);
  if (area.lower > 0 && area.upper < 1) share.add(area, exact);
}

/// Corners around the square, at most about so far from it, one edge through it; of positive area.
SquareTriangle triangle_from(Numbers& n, double size) {
  for (;;) {
    SquareTriangle t;
    for (SquarePoint& p : t) p = {n.unit() * size, n.unit() * size};
    if (cross(t) < 0) std::swap(t[1], t[2]);
    const double share = (1 + n.unit()) / 2;
    const double dx = (1 + n.unit()) / 2 - (t[0].x + share * (t[1].x - t[0].x));
    const double dy = (1 + n.unit()) / 2 - (t[0].y + share * (t[1].y - t[0].y));
    for (SquarePoint& p : t) p = {p.x + dx, p.y + dy};
    if (cross(t) > 0x1p-20 * size * size) return t;
  }
}

TEST(AreaShares, OfCrossings) {
  Numbers n(31);
  Share share;
  for (int i = 0; i < 20000 / effort; ++i) {
    const double size = std::ldexp(1, n.below(30)), rise = std::ldexp(1, n.below(12) - 4);
    const SquarePoint p{n.unit() * size, n.unit() * rise}, q{n.unit() * size, n.unit() * rise};
    SquareEdges edges;
    edges.clear();
    edges.add(p, q, 0);
    if (edges.edges().empty()) continue;
    const SquareEdges::Edge& edge = edges.edges().front();
    const double bound =
        area_bounds::crossing_error * std::max({1.0, std::abs(p.x), std::abs(q.x)});
    const Ratio slope(Dyadic(q.x) - Dyadic(p.x), Dyadic(q.y) - Dyadic(p.y));
    const auto add = [&](double height, double x) {
      share.add(x, Ratio(p.x) + slope * Ratio(Dyadic(height) - Dyadic(p.y)), bound);
    };
    add(edge.low, edge.x_low);
    add(edge.high, edge.x_high);
    const double height = edge.low + (edge.high - edge.low) * (1 + n.unit()) / 2;
    add(height, edge.at(height));
  }
  EXPECT_GT(share.count(), 20000 / effort);
  expect_share(share.publish("crossing_error"), 0.15);
}

Ratio exact_area_of(const SquareTriangle& t) {
  Polygon polygon = unit_square();
  for (std::size_t k = 0; k < 3; ++k) {
    const SquarePoint &p = t[k], &q = t[(k + 1) % 3];
    polygon = beside_line(polygon, {Q(p.x), Q(p.y)}, {Q(q.x), Q(q.y)});
  }
  return area_of(polygon);
}

/// Of the bound for the edges as computed: their corners are exact.
TEST(AreaShares, OfUnions) {
  Numbers n(32);
  Share one, several;
  for (int i = 0; i < 8000 / effort; ++i) {
    const double size = std::ldexp(1, n.below(16));
    PixelUnion pixel;
    pixel.clear();
    const SquareTriangle t = triangle_from(n, size);
    pixel.add(t, 0);
    add_interval(pixel.area(), exact_area_of(t), one);
    if (i % 16 != 0) continue;
    std::vector<SquareTriangle> triangles{t};
    while (triangles.size() < 4) triangles.push_back(triangle_from(n, size));
    for (std::size_t k = 1; k < 4; ++k) pixel.add(triangles[k], 0);
    add_interval(pixel.area(), exactly(exact_area(triangles).get_mpq_t()), several);
  }
  EXPECT_GT(one.count(), 6000 / effort);
  EXPECT_GT(several.count(), 100 / effort);
  expect_share(one.publish("of_one"), 0.002);
  expect_share(several.publish("of_four"), 0.0003);
}

/// Each coordinate is moved by `error`, one way or the other.
oracle::Point moved(Numbers& n, const SquarePoint& p, double error) {
  const Q e(error);
  return {n.below(2) ? Q(p.x + e) : Q(p.x - e), n.below(2) ? Q(p.y + e) : Q(p.y - e)};
}

/// A line through the square, many of them near its diagonals, with ends outside, the first often
/// far away.
std::array<SquarePoint, 2> line_from(Numbers& n) {
  const double spread = std::ldexp(1, -n.below(12));
  const double near = -std::ldexp(1 + n.unit() / 2, n.below(8) - 1);
  const double far = 1 + std::ldexp(1, -1 - n.below(6));
  std::array<SquarePoint, 2> line{
      {{near, near * (1 - spread)}, {far, 1 + (far - 1) * (1 - spread * n.unit())}}};
  if (n.below(2)) std::swap(line[0].y, line[1].y);
  return line;
}

TEST(AreaShares, OfMovedEdges) {
  Numbers n(33);
  Share share;
  for (int i = 0; i < 4000 / effort; ++i) {
    auto [p, q] = line_from(n);
    if (n.below(2)) std::swap(p, q);
    const double error = std::ldexp(1, -12 - n.below(16));
    PixelWinding pixel;
    pixel.clear();
    pixel.add(p, q, error);
    const Interval area = pixel.area([&, from = p, to = q](const SquarePoint& s) {
      const double side = cross({from, to, s});
      return std::abs(side) < 16 * error ? -1 : side > 0 ? 1 : 0;
    });
    if (area.upper - area.lower > 0.5) continue;  // no number was certain
    add_interval(area, area_of(beside_line(unit_square(), moved(n, p, error), moved(n, q, error))),
                 share);
  }
  EXPECT_GT(share.count(), 2000 / effort);
  expect_share(share.publish("moved_edge"), 0.4);
}

/// An edge alone, with exact ends: also of areas that are next to nothing.
TEST(AreaShares, OfEdgesAlone) {
  Numbers n(39);
  Share share;
  for (int i = 0; i < 4000 / effort; ++i) {
    auto [p, q] = line_from(n);
    if (i % 2 == 0) {  // cuts off a corner
      const double cut = std::ldexp(1 + n.unit() / 2, -n.below(20));
      const double far = std::ldexp(1, n.below(12));
      p = {cut * (1 + far), -cut * far};
      q = {-cut * far, cut * (1 + far) * (1 + n.unit() / 4)};
    }
    if (n.below(2)) std::swap(p, q);
    PixelWinding pixel;
    pixel.clear();
    pixel.add(p, q, 0);
    const Interval area = pixel.area([&, from = p, to = q](const SquarePoint& s) {
      const double side = cross({from, to, s});
      return std::abs(side) < 0x1p-30 ? -1 : side > 0 ? 1 : 0;
    });
    if (area.upper - area.lower > 0.5) continue;  // no number was certain
    add_interval(area, area_of(beside_line(unit_square(), {Q(p.x), Q(p.y)}, {Q(q.x), Q(q.y)})),
                 share);
  }
  EXPECT_GT(share.count(), 2000 / effort);
  expect_share(share.publish("of_edges_alone"), 0.02);
}

TEST(AreaShares, OfMovedTriangles) {
  Numbers n(34);
  Share share;
  for (int i = 0; i < 4000 / effort; ++i) {
    SquareTriangle t = triangle_from(n, 1.5);
    if (n.below(2)) {  // thin, with two sides along a line through the square
      const auto [p, q] = line_from(n);
      t = {p, q, {q.x + n.unit() / 16, q.y + n.unit() / 16}};
      if (cross(t) < 0) std::swap(t[1], t[2]);
    }
    const double error = std::ldexp(1, -12 - n.below(16));
    if (cross(t) < 1024 * error) continue;  // it might be turned
    PixelUnion pixel;
    pixel.clear();
    pixel.add(t, area_bounds::moved_triangle * error);
    Polygon exact = unit_square();
    const std::array corners{moved(n, t[0], error), moved(n, t[1], error), moved(n, t[2], error)};
    for (std::size_t k = 0; k < 3; ++k) {
      exact = beside_line(exact, corners[k], corners[(k + 1) % 3]);
    }
    add_interval(pixel.area(), area_of(exact), share);
  }
  EXPECT_GT(share.count(), 2000 / effort);
  expect_share(share.publish("moved_triangle"), 0.2);
}

/// A function that differs from f by at most `error` in the square, as much as it may in places.
std::array<Q, 3> uncertain(Numbers& n, const UncertainHalfPlane& f) {
  const Q e = n.below(2) ? Q(f.error) : Q(-f.error);
  switch (n.below(4)) {
    case 0:
      return {f.a + 2 * e, Q(f.b), f.c - e};
    case 1:
      return {Q(f.a), f.b + 2 * e, f.c - e};
    case 2:
      return {f.a + e, f.b + e, f.c - e};
    default:
      return {Q(f.a), Q(f.b), f.c + e};
  }
}

void add_cut(Numbers& n, const UncertainHalfPlane& f, Share& share) {
  ClippedSquare square;
  square.clip(f);
  const auto [a, b, c] = uncertain(n, f);
  Polygon computed;
  for (const SquarePoint& p : square.corners()) computed.push_back({Q(p.x), Q(p.y)});
  const Q of_computed = oracle::twice_area(computed) / 2;
  const Q error = of_computed - oracle::twice_area(oracle::clipped(unit_square(), a, b, c)) / 2;
  if (square.area_error() > 0) {
    share.add(0.0, exactly(error.get_mpq_t()), square.area_error());
  } else {
    EXPECT_EQ(sgn(error), 0);
  }
}

TEST(AreaShares, OfCuts) {
  Numbers n(35);
  Share by_error, by_rounding;
  for (int i = 0; i < 6000 / effort; ++i) {
    const double tilt = n.below(2) ? n.unit() : 1 - std::ldexp(1, -n.below(20));
    const double a = n.below(2) ? 1 : tilt, b = a == 1 ? tilt : -1;
    const double c = n.unit() - (a + b) / 2;
    add_cut(n, {a, b, c, std::ldexp(1, -8 - n.below(24))}, by_error);
    // Of few bits: the function is computed exactly at the corners of the square.
    const auto whole = [&] { return std::round(n.unit() * 0x1p30) * 0x1p-30; };
    add_cut(n, {whole(), whole(), whole(), 0}, by_rounding);
  }
  EXPECT_GT(by_error.count(), 3000 / effort);
  EXPECT_GT(by_rounding.count(), 2000 / effort);
  expect_share(by_error.publish("cut_error"), 0.1);
  expect_share(by_rounding.publish("cut_rounding"), 0.005);
}

}  // namespace
}  // namespace fathom
