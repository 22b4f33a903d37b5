// Scan conversion against the words of its definitions, over small polygons with many ties.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <set>

#include "fathom/pipeline/scan/area_fill.h"
#include "fathom/pipeline/scan/diamond_exit.h"
#include "fathom/pipeline/scan/edge_function.h"
#include "fathom/pipeline/scan/line.h"
#include "fathom/pipeline/scan/polygon_tests.h"

namespace fathom::pipeline {
namespace {

/// Coordinates in halves.
using Corner = std::array<int, 2>;

Ring<Exact> ring_of(const std::vector<Corner>& corners) {
  Ring<Exact> ring;
  for (const auto& [x, y] : corners) ring.push_back({Exact(x) / 2, Exact(y) / 2});
  return ring;
}

/// Positive if p, q, r run counter-clockwise as numbers.
int turn(const Corner& p, const Corner& q, const Corner& r) {
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

std::vector<Corner> random_ring(std::mt19937_64& random, std::size_t count) {
  std::vector<Corner> ring;
  for (std::size_t i = 0; i < count; ++i) {
    ring.push_back({static_cast<int>(random() % 13), static_cast<int>(random() % 13)});
  }
  return ring;
}

struct Crossings {
  int count = 0, winding = 0;
  bool on_outline = false;
};

/// A ray to the right; an edge has its upper end (with y down, the lesser y) and not its lower one.
Crossings crossings_of(const std::vector<Corner>& ring, const Corner& p) {
  Crossings result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Corner &a = ring[i], &b = ring[(i + 1) % ring.size()];
    const bool between = std::min(a[0], b[0]) <= p[0] && p[0] <= std::max(a[0], b[0]) &&
                         std::min(a[1], b[1]) <= p[1] && p[1] <= std::max(a[1], b[1]);
    result.on_outline = result.on_outline || (between && turn(a, b, p) == 0);
    const Corner &top = a[1] < b[1] ? a : b, &bottom = a[1] < b[1] ? b : a;
    if (!(top[1] <= p[1] && p[1] < bottom[1])) continue;
    // x of the edge in row p.y, times the height: to the right of p?
    const int height = bottom[1] - top[1];
    if (top[0] * height + (p[1] - top[1]) * (bottom[0] - top[0]) <= p[0] * height) continue;
    ++result.count;
    result.winding += a[1] < b[1] ? -1 : 1;  // down on the right: clockwise as seen
  }
  return result;
}

TEST(RayCrossings, AreCountedToTheRight) {
  std::mt19937_64 random(61);
  int twice = 0, on = 0;
  for (int i = 0; i < 400; ++i) {
    const auto ring = random_ring(random, 3 + random() % 6);
    const Rings<Exact> rings{ring_of(ring)};
    for (int k = 0; k < 30; ++k) {
      const Corner p{static_cast<int>(random() % 13), static_cast<int>(random() % 13)};
      const auto found = ray_crossings<Exact>(rings, {Exact(p[0]) / 2, Exact(p[1]) / 2});
      const Crossings right = crossings_of(ring, p);
      ASSERT_EQ(found.count, right.count);
      ASSERT_EQ(found.winding, right.winding);
      ASSERT_EQ(found.on_outline, right.on_outline);
      twice += std::abs(right.winding) > 1;
      on += right.on_outline;
    }
  }
  EXPECT_GT(twice, 20);
  EXPECT_GT(on, 200);
}

TEST(OneSideOfEveryEdge, IsWhatItSays) {
  std::mt19937_64 random(62);
  int yes = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto ring = random_ring(random, 3 + random() % 2);
    const Corner p{static_cast<int>(random() % 13), static_cast<int>(random() % 13)};
    bool some_left = false, some_right = false;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const int side = turn(ring[k], ring[(k + 1) % ring.size()], p);
      some_left = some_left || side > 0;
      some_right = some_right || side < 0;
    }
    const bool right = some_left != some_right;
    ASSERT_EQ(
        is_on_one_side_of_every_edge<Exact>(ring_of(ring), {Exact(p[0]) / 2, Exact(p[1]) / 2}),
        right);
    yes += right;
  }
  EXPECT_GT(yes, 200);
}

TEST(ConvexHull, IsTheLeastThatHoldsAllPoints) {
  std::mt19937_64 random(63);
  for (int i = 0; i < 600; ++i) {
    const auto points = random_ring(random, 3 + random() % 8);
    std::vector<Point<Exact>> exact;
    for (const auto& p : ring_of(points)) exact.push_back(p);
    const Ring<Exact> hull = convex_hull(exact);
    // The corners: points that do not lie between two others, nor within a triangle of others.
    std::set<Corner> corners(points.begin(), points.end());
    const std::vector<Corner> all(corners.begin(), corners.end());
    for (const Corner& p : all) {
      // p is a corner if all others lie strictly within less than half a turn around it.
      bool corner = all.size() < 3;
      for (const Corner& q : all) {
        if (q == p || corner) continue;
        corner = std::all_of(all.begin(), all.end(), [&](const Corner& r) {
          const int side = turn(p, q, r);
          const int along = (q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1]);
          return r == p || side > 0 || (side == 0 && along > 0);
        });
      }
      if (!corner) corners.erase(p);
    }
    std::set<Corner> found;
    for (const auto& p : hull) {
      found.insert({static_cast<int>(to_binary64(Exact(p.x * 2))),
                    static_cast<int>(to_binary64(Exact(p.y * 2)))});
    }
    ASSERT_EQ(found, corners) << i;
    ASSERT_EQ(hull.size(), corners.size());
    // One way around.
    for (std::size_t k = 0; k < hull.size() && hull.size() > 2; ++k) {
      ASSERT_TRUE(left_of(hull[k], hull[(k + 1) % hull.size()], hull[(k + 2) % hull.size()]) > 0);
    }
  }
}

TEST(Convexity, TurnsSidesAndTurningNumbers) {
  std::mt19937_64 random(64);
  int convex = 0, stars = 0;
  for (int i = 0; i < 6000; ++i) {
    const auto ring = random_ring(random, 3 + random() % 4);
    const Convexity found = convexity_of(ring_of(ring));
    const std::size_t n = ring.size();
    ASSERT_EQ(found.turns.size(), n);
    double angle = 0;
    bool left = false, right = false, turns_back = false, sides_left = false, sides_right = false,
         apart = true;
    for (std::size_t k = 0; k < n; ++k) {
      const Corner &a = ring[(k + n - 1) % n], &b = ring[k], &c = ring[(k + 1) % n];
      // As seen, y down: to the left is negative as numbers.
      const int side = -turn(a, b, c);
      ASSERT_EQ(found.turns[k], (side > 0) - (side < 0));
      left = left || side > 0;
      right = right || side < 0;
      const double ux = b[0] - a[0], uy = a[1] - b[1], vx = c[0] - b[0], vy = b[1] - c[1];
      turns_back = turns_back || (side == 0 && ux * vx + uy * vy <= 0);
      angle += std::atan2(ux * vy - uy * vx, ux * vx + uy * vy);
      sides_left = sides_right = false;
      for (const Corner& p : ring) {
        sides_left = sides_left || turn(b, c, p) > 0;
        sides_right = sides_right || turn(b, c, p) < 0;
      }
      apart = apart && !(sides_left && sides_right);
    }
    ASSERT_EQ(found.turning_number.has_value(), !turns_back);
    if (turns_back) {
      EXPECT_FALSE(found.convex);
      continue;
    }
    const auto number = static_cast<int>(std::lround(angle / (2 * std::acos(-1.0))));
    ASSERT_EQ(*found.turning_number, number);
    ASSERT_EQ(found.convex, left != right && std::abs(number) == 1);
    convex += found.convex;
    stars += std::abs(number) > 1;
    // Of some triangle or quadrangle both ways of asking say the same.
    if (left != right && std::abs(number) == 1) {
      EXPECT_TRUE(found.corners_on_one_side);
    }
  }
  EXPECT_GT(convex, 500);
  EXPECT_GT(stars, 5);
}

/// Left and top edges shorter than a pixel, with a centre on them; and all other triangles of
/// halves.
TEST(EdgeFunction, TrianglesCoverWhatTheRuleSays) {
  std::mt19937_64 random(65);
  const auto covered_by = [](const std::vector<Corner>& t, const Corner& p) {
    const int area = turn(t[0], t[1], t[2]);
    if (area == 0) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      Corner a = t[k], b = t[(k + 1) % 3];
      if (area < 0) std::swap(a, b);
      const int side = turn(a, b, p);
      const int right = a[1] - b[1], down = b[0] - a[0];  // the inward normal
      if (side < 0 || (side == 0 && !(right > 0 || (right == 0 && down > 0)))) return false;
    }
    return true;
  };
  int on_short_edges = 0;
  for (int i = 0; i < 3000; ++i) {
    auto t = random_ring(random, 3);
    if (i % 4 == 0) t[1] = {t[0][0], t[0][1] + 2};  // a short upright edge, a centre in its middle
    if (i % 4 == 1) t[1] = {t[0][0] + 2, t[0][1]};  // a short level one
    std::set<Pixel> drawn;
    const Ring<Exact> ring = ring_of(t);
    rasterize_triangle<Exact>({ring[0], ring[1], ring[2]}, {1, 0, 6, 5}, [&](const auto& covered) {
      drawn.insert(covered.pixel);
      ASSERT_EQ(Exact(covered.barycentric[0] + covered.barycentric[1] + covered.barycentric[2]), 1);
      const auto& p = covered.pixel;
      Exact x(0), y(0);
      for (std::size_t k = 0; k < 3; ++k) {
        x += covered.barycentric[k] * ring[k].x;
        y += covered.barycentric[k] * ring[k].y;
      }
      ASSERT_EQ(x, Exact(2 * p.x + 1) / 2);
      ASSERT_EQ(y, Exact(2 * p.y + 1) / 2);
    });
    for (int y = -1; y <= 7; ++y) {
      for (int x = -1; x <= 7; ++x) {
        const bool asked = x >= 1 && x < 6 && y >= 0 && y < 5;
        const bool covered = covered_by(t, {2 * x + 1, 2 * y + 1});
        ASSERT_EQ(drawn.count({x, y}), asked && covered) << i << " " << x << " " << y;
        on_short_edges += covered && i % 4 < 2 && turn(t[0], t[1], {2 * x + 1, 2 * y + 1}) == 0;
      }
    }
  }
  EXPECT_GT(on_short_edges, 50);
}

/// Spans against the winding number at each centre, both rules, and attributes against their plane.
TEST(PolygonFill, IsTheWindingNumberOfCentres) {
  std::mt19937_64 random(66);
  int inside = 0, twice = 0;
  for (int i = 0; i < 500; ++i) {
    const auto ring = random_ring(random, 3 + random() % 5);
    FillPolygon<Exact> polygon(1);
    for (const auto& p : ring_of(ring))
      polygon[0].push_back({p.x, p.y, {Exact(3 * p.x - 2 * p.y + 7)}});
    for (const FillRule rule : {FillRule::even_odd, FillRule::non_zero}) {
      std::set<Pixel> drawn;
      const PixelWindow window{1, 1, 5, 6};
      fill_polygon<Exact>(polygon, rule, window, [&](const ScanLine<Exact>& line) {
        for (const auto& span : line.spans) {
          const auto values = values_along(span);
          for (std::int64_t x = span.pixels.x_begin; x < span.pixels.x_end; ++x) {
            ASSERT_TRUE(drawn.insert({x, line.y}).second);
            const auto k = static_cast<std::size_t>(x - span.pixels.x_begin);
            ASSERT_EQ(values[k][0], Exact(3 * (2 * x + 1) - 2 * (2 * line.y + 1)) / 2 + 7);
          }
        }
      });
      for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 7; ++x) {
          // A centre on an edge belongs to what lies to its right: crossings at it are to its left.
          const Crossings c = crossings_of(ring, {2 * x + 1, 2 * y + 1});
          const bool covered = rule == FillRule::even_odd ? c.count % 2 != 0 : c.winding != 0;
          const bool asked = window.contains({x, y});
          ASSERT_EQ(drawn.count({x, y}), asked && covered) << i << " " << x << " " << y;
          inside += covered;
          twice += std::abs(c.winding) > 1;
        }
      }
    }
  }
  EXPECT_GT(inside, 2000);
  EXPECT_GT(twice, 50);
}

/// The parameters at which a segment is inside a diamond, its ε a small number instead of a symbol.
std::optional<std::array<Exact, 2>> within_diamond(const WindowSegment<Exact>& s, const Pixel& p) {
  Exact enters(0), leaves(2);
  for (const int sx : {-1, 1}) {
    for (const int sy : {-1, 1}) {
      // sx·(x − x_c) + sy·(y − y_c) < ½
      const Exact at_start =
          sx * (s.x0 - centre_of<Exact>(p.x)) + sy * (s.y0 - centre_of<Exact>(p.y)) - Exact(1) / 2;
      const Exact slope = sx * (s.x1 - s.x0) + sy * (s.y1 - s.y0);
      if (slope == 0) {
        if (at_start >= 0) return std::nullopt;
      } else if (slope > 0) {
        leaves = std::min(leaves, Exact(-at_start / slope));
      } else {
        enters = std::max(enters, Exact(-at_start / slope));
      }
    }
  }
  if (!(enters < leaves)) return std::nullopt;
  return std::array{enters, leaves};
}

TEST(DiamondExit, DrawsTheDiamondsThatAreLeftInTheirOrder) {
  std::mt19937_64 random(67);
  // Far less than any difference between quotients of numbers below 2⁶.
  const Exact epsilon = Exact(1) / Exact(std::int64_t{1} << 40);
  std::size_t all = 0;
  for (int i = 0; i < 1500; ++i) {
    const auto number = [&] { return Exact(static_cast<int>(random() % 33) - 4) / 4; };
    const WindowSegment<Exact> s{number(), number(), number(), number()};
    const WindowSegment<Exact> moved{s.x0 - epsilon, s.y0 - epsilon * epsilon, s.x1 - epsilon,
                                     s.y1 - epsilon * epsilon};
    const PixelWindow window = i % 2 == 0 ? PixelWindow{-3, -3, 10, 10} : PixelWindow{1, 0, 5, 6};
    std::vector<std::pair<Exact, Pixel>> right;
    for (std::int64_t y = window.y_begin; y < window.y_end; ++y) {
      for (std::int64_t x = window.x_begin; x < window.x_end; ++x) {
        const auto t = within_diamond(moved, {x, y});
        if (t && (*t)[1] < 1) right.push_back({(*t)[0], {x, y}});
      }
    }
    std::sort(right.begin(), right.end());
    std::vector<Pixel> drawn, expected;
    diamond_exit_line<Exact>(s, window, [&](const Pixel& p) { drawn.push_back(p); });
    for (const auto& [t, p] : right) expected.push_back(p);
    ASSERT_EQ(drawn, expected) << i;
    all += drawn.size();
  }
  EXPECT_GT(all, 3000u);
}

TEST(Lines, AWindowShowsAPartOfTheSameLine) {
  std::mt19937_64 random(68);
  for (int i = 0; i < 400; ++i) {
    const auto at = [&] { return static_cast<std::int64_t>(random() % 60) - 20; };
    const LineEnds ends{at(), at(), at(), at()};
    const PixelWindow window{at(), at(), at() + 20, at() + 20};
    const auto same = [&](const auto& draw) {
      using State = decltype(draw(PixelWindow{})[0].second);
      std::vector<std::pair<Pixel, State>> inside;
      for (const auto& [pixel, state] : draw(PixelWindow{})) {
        if (window.contains(pixel)) inside.push_back({pixel, state});
      }
      ASSERT_EQ(draw(window), inside) << i;
    };
    same([&](const PixelWindow& w) {
      std::vector<std::pair<Pixel, double>> drawn;
      dda_line<double>(ends, w, [&](const Pixel& p, double y) { drawn.emplace_back(p, y); });
      return drawn;
    });
    same([&](const PixelWindow& w) {
      std::vector<std::pair<Pixel, double>> drawn;
      explicit_line<double>(ends, w, [&](const Pixel& p, double y) { drawn.emplace_back(p, y); });
      return drawn;
    });
    same([&](const PixelWindow& w) {
      std::vector<std::pair<Pixel, std::int64_t>> drawn;
      bresenham_line(ends, w, [&](const Pixel& p, std::int64_t e) { drawn.emplace_back(p, e); });
      return drawn;
    });
    same([&](const PixelWindow& w) {
      std::vector<std::pair<Pixel, std::int64_t>> drawn;
      midpoint_line(ends, w, [&](const Pixel& p, std::int64_t d) { drawn.emplace_back(p, d); });
      return drawn;
    });
  }
}

TEST(FloodFill, SeedsBesideTheGridFillNothing) {
  const CharacterGrid grid{"aaa", "aaa"};
  for (std::int64_t y = -1; y <= 2; ++y) {
    for (std::int64_t x = -1; x <= 3; ++x) {
      const bool inside = x >= 0 && x < 3 && y >= 0 && y < 2;
      EXPECT_EQ(flood_fill(grid, {x, y}, Connectivity::four).size(), inside ? 6u : 0u);
    }
  }
}

}  // namespace
}  // namespace fathom::pipeline
