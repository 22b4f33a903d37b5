// Triangles: edge functions, the subpixel grid, and scan lines against one another and known
// answers.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/pipeline/scan/area_fill.h"
#include "fathom/pipeline/scan/edge_function.h"
#include "tests/effort.h"

namespace fathom::pipeline {
namespace {

using Triangle = std::array<Point<Exact>, 3>;

Triangle triangle_of(double ax, double ay, double bx, double by, double cx, double cy) {
  return {{{Exact(ax), Exact(ay)}, {Exact(bx), Exact(by)}, {Exact(cx), Exact(cy)}}};
}

std::vector<Pixel> by_edge_functions(const Triangle& t) {
  std::vector<Pixel> pixels;
  rasterize_triangle<Exact>(t, {}, [&](const auto& covered) { pixels.push_back(covered.pixel); });
  return pixels;
}

std::vector<Pixel> by_scan_lines(const Triangle& t) {
  std::vector<Pixel> pixels;
  fill_polygon<Exact>({{{t[0].x, t[0].y, {}}, {t[1].x, t[1].y, {}}, {t[2].x, t[2].y, {}}}},
                      FillRule::even_odd, {}, [&](const auto& line) {
                        for (const auto& span : line.spans)
                          for (auto x = span.pixels.x_begin; x < span.pixels.x_end; ++x)
                            pixels.push_back({x, line.y});
                      });
  return pixels;
}

TEST(Triangle, FragmentCountsOfTheDemo) {
  // The two triangles of section 6 of the source, counted here by an independent formula: the
  // number of centres is checked against the sum over rows of ⌈x_right − ½⌉ − ⌈x_left − ½⌉, which
  // scan lines compute.
  const Triangle near = triangle_of(80, 30, 30, 200, 200, 180);
  const Triangle far = triangle_of(160, 20, 100, 220, 290, 150);
  EXPECT_EQ(by_edge_functions(near), by_scan_lines(near));
  EXPECT_EQ(by_edge_functions(far), by_scan_lines(far));
  // Areas 13950 and 16900; a count differs from its area by less than the outline is long.
  EXPECT_NEAR(double(by_edge_functions(near).size()), 13950, 540);
  EXPECT_NEAR(double(by_edge_functions(far).size()), 16900, 700);
}

TEST(Triangle, BothWindingsCoverTheSameAndZeroAreaNothing) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> quarters(0, 60);
  for (int i = 0; i < 500 / checks::effort; ++i) {
    const auto q = [&] { return quarters(random) / 4.0; };
    const Triangle t = triangle_of(q(), q(), q(), q(), q(), q());
    const auto pixels = by_edge_functions(t);
    ASSERT_EQ(pixels, by_edge_functions({t[0], t[2], t[1]}));
    ASSERT_EQ(pixels, by_edge_functions({t[1], t[2], t[0]}));
    ASSERT_EQ(pixels, by_scan_lines(t));
  }
  EXPECT_TRUE(by_edge_functions(triangle_of(0, 0, 5, 5, 9, 9)).empty());
  // Tiny, but real: 1e-12 wide around a centre.
  EXPECT_EQ(by_edge_functions(triangle_of(0.5 - 1e-12, 0.5, 0.5 + 1e-12, 0.5 - 1e-12, 0.5, 1)),
            (std::vector<Pixel>{{0, 0}}));
}

/// The two right triangles whose areas, 100 and 18, are their counts: as many centres on the
/// slanted edge's one side as beyond it.
TEST(Triangle, OneHundredAndEighteenPixels) {
  EXPECT_EQ(by_edge_functions(triangle_of(0, 0, 20, 0, 0, 10)).size(), 100u);
  EXPECT_EQ(by_edge_functions(triangle_of(0, 0, 9, 0, 0, 4)).size(), 18u);
}

TEST(Triangle, BoundingBoxIsThePixelsThatItTouches) {
  EXPECT_EQ(bounding_box<Exact>(triangle_of(0, 0, 20, 0, 0, 10), {}), (PixelWindow{0, 0, 20, 10}));
  EXPECT_EQ(bounding_box<Exact>(triangle_of(0.75, -0.25, 3.25, 2, 1, 2.5), {}),
            (PixelWindow{0, -1, 4, 3}));
  EXPECT_EQ(bounding_box<Exact>(triangle_of(0.75, -0.25, 3.25, 2, 1, 2.5), {1, 0, 9, 2}),
            (PixelWindow{1, 0, 4, 2}));
}

TEST(Triangle, TopLeftRuleOnASquareOfTwo) {
  const auto upper = by_edge_functions(triangle_of(0.5, 0.5, 4.5, 0.5, 0.5, 4.5));
  const auto lower = by_edge_functions(triangle_of(4.5, 0.5, 4.5, 4.5, 0.5, 4.5));
  std::vector<Pixel> both = upper;
  both.insert(both.end(), lower.begin(), lower.end());
  std::sort(both.begin(), both.end());
  EXPECT_EQ(std::adjacent_find(both.begin(), both.end()), both.end());
  EXPECT_EQ(both.size(), 16u);
  EXPECT_EQ(upper.size(), 10u);  // 4 + 3 + 2 + 1: the slanted edge is a right one
}

TEST(Triangle, BarycentricCoordinatesAreAreaRatiosAndTwoInterpolations) {
  const Triangle t = triangle_of(1, 2, 17, 5, 6, 15);
  rasterize_triangle<Exact>(t, {}, [&](const CoveredPixel<Exact>& covered) {
    const auto& [alpha, beta, gamma] = covered.barycentric;
    ASSERT_EQ(alpha + beta + gamma, Exact(1));
    ASSERT_EQ(alpha * t[0].x + beta * t[1].x + gamma * t[2].x, centre_of<Exact>(covered.pixel.x));
    ASSERT_EQ(alpha * t[0].y + beta * t[1].y + gamma * t[2].y, centre_of<Exact>(covered.pixel.y));
    // V' = V + s(R − V), V = P + u(Q − P): s = gamma, u = beta / (1 − s).
    const Exact s = gamma, u = beta / (Exact(1) - s);
    ASSERT_EQ(Exact(1) - u - s + s * u, alpha);
  });
}

TEST(Triangle, TwoStepInterpolationEqualsBarycentric) {
  std::mt19937 random(6);
  std::uniform_int_distribution<int> quarters(0, 60), value(-9, 9);
  for (int i = 0; i < 200 / checks::effort; ++i) {
    const auto q = [&] { return quarters(random) / 4.0; };
    const Triangle t = triangle_of(q(), q(), q(), q(), q(), q());
    const std::array<Exact, 3> R{Exact(value(random)), Exact(value(random)), Exact(value(random))};
    std::map<Pixel, Exact> expected, found;
    rasterize_triangle<Exact>(t, {}, [&](const CoveredPixel<Exact>& c) {
      expected[c.pixel] =
          c.barycentric[0] * R[0] + c.barycentric[1] * R[1] + c.barycentric[2] * R[2];
    });
    fill_polygon<Exact>(
        {{{t[0].x, t[0].y, {R[0]}}, {t[1].x, t[1].y, {R[1]}}, {t[2].x, t[2].y, {R[2]}}}},
        FillRule::even_odd, {}, [&](const auto& line) {
          for (const auto& span : line.spans) {
            const auto along = values_along(span);
            for (std::size_t k = 0; k < along.size(); ++k)
              found[{span.pixels.x_begin + std::int64_t(k), line.y}] = along[k][0];
          }
        });
    ASSERT_EQ(found, expected);
  }
}

TEST(SubpixelGrid, SnapsToNearestTiesToEven) {
  EXPECT_EQ(snap(1.5, 0), 2 * grid_one);
  EXPECT_EQ(snap(2.5, 0), 2 * grid_one);
  EXPECT_EQ(snap(-0.5, 0), 0);
  EXPECT_EQ(snap(0.3, 8), 77 * (grid_one >> 8));  // 76.8
  EXPECT_EQ(snap(-2147483648.0, 16), -(std::int64_t{1} << 31) * grid_one);
}

/// The demo of the textbooks: centres on any edge count, in either winding.
TEST(EdgeFunction, ClosedEdgesAreEveryTriangles) {
  using Corners = std::array<Point<Exact>, 3>;
  const auto triangle = [](std::array<std::array<int, 2>, 3> c) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = {Exact(c[k][0]), Exact(c[k][1])};
    return corners;
  };
  const Corners near = triangle({{{80, 30}, {30, 200}, {200, 180}}});
  const Corners far = triangle({{{160, 20}, {100, 220}, {290, 150}}});
  const auto pixels = [](Corners corners, EdgeRule rule, bool turned) {
    if (turned) std::swap(corners[1], corners[2]);
    std::set<Pixel> covered;
    rasterize_triangle<Exact>(
        corners, {}, [&](const auto& c) { covered.insert(c.pixel); }, rule);
    return covered;
  };
  for (const bool turned : {false, true}) {
    const auto near_closed = pixels(near, EdgeRule::closed, turned);
    auto all = pixels(far, EdgeRule::closed, turned);
    EXPECT_EQ(near_closed.size(), 13955u);
    EXPECT_EQ(all.size(), 16970u);
    all.insert(near_closed.begin(), near_closed.end());
    EXPECT_EQ(all.size(), 26933u);
    EXPECT_EQ(pixels(far, EdgeRule::top_left, turned).size(), 16830u);
  }
}

TEST(SubpixelGrid, CoversWhatExactEdgeFunctionsOfTheSnappedCornersDo) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> coordinate(-3, 14);
  for (int i = 0; i < 1200 / checks::effort; ++i) {
    const int bits = i % 17;
    std::array<GridPoint, 3> corners;
    Triangle exact;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = snap(coordinate(random), coordinate(random), bits);
      exact[k] = {Exact(corners[k].x) / Exact(grid_one), Exact(corners[k].y) / Exact(grid_one)};
    }
    const auto t = GridTriangle::of(corners);
    std::vector<Pixel> pixels, spans;
    if (t) {
      const PixelWindow box = t->bounding_box();
      for (std::int64_t y = -4; y < 16; ++y) {
        const Span span = t->span_of_row(y, {-4, -4, 16, 16});
        for (std::int64_t x = span.x_begin; x < span.x_end; ++x) spans.push_back({x, y});
        for (std::int64_t x = -4; x < 16; ++x) {
          if (!t->covers(sample_of({x, y}))) continue;
          pixels.push_back({x, y});
          ASSERT_TRUE(box.contains({x, y}));
        }
      }
    }
    ASSERT_EQ(pixels, by_edge_functions(exact));
    ASSERT_EQ(spans, pixels);
  }
}

TEST(SubpixelGrid, BlocksTellTheTruth) {
  std::mt19937_64 random(10);
  std::uniform_real_distribution<double> coordinate(-10, 42);
  int all = 0, none = 0;
  for (int i = 0; i < 200 / checks::effort; ++i) {
    const auto t = GridTriangle::of({snap(coordinate(random), coordinate(random), 8),
                                     snap(coordinate(random), coordinate(random), 8),
                                     snap(coordinate(random), coordinate(random), 8)});
    if (!t) continue;
    for (std::int64_t y = 0; y < 32; y += 8) {
      for (std::int64_t x = 0; x < 32; x += 8) {
        const auto answer = t->test_block({x, y}, 8);
        int covered = 0;
        for (int k = 0; k < 64; ++k) covered += t->covers(sample_of({x + k % 8, y + k / 8}));
        all += answer == GridTriangle::BlockCoverage::all;
        none += answer == GridTriangle::BlockCoverage::none;
        if (answer == GridTriangle::BlockCoverage::all) {
          ASSERT_EQ(covered, 64);
        }
        if (answer == GridTriangle::BlockCoverage::none) {
          ASSERT_EQ(covered, 0);
        }
      }
    }
  }
  EXPECT_GT(all, 0);
  EXPECT_GT(none, 0);
}

/// A mesh of a square: a grid of corners moved at random, each cell cut in two.
struct GridMesh {
  static constexpr int n = 9;
  std::vector<std::array<double, 2>> corners;
  std::vector<std::array<int, 3>> triangles;

  GridMesh(std::mt19937_64& random, double shake) {
    std::uniform_real_distribution<double> move(-shake, shake);
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x) {
        const bool border = x == 0 || y == 0 || x == n || y == n;
        corners.push_back(
            {x * 1.7 + (border ? 0 : move(random)), y * 1.7 + (border ? 0 : move(random))});
      }
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        const int a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
        if (random() % 2) {
          triangles.push_back({a, c, b});
          triangles.push_back({b, c, d});
        } else {
          triangles.push_back({a, c, d});
          triangles.push_back({a, d, b});
        }
      }
  }
};

TEST(SubpixelGrid, SharedEdgesCoverEverySampleOnceAtEveryNumberOfBits) {
  std::mt19937_64 random(77);
  int flips = 0, samples_with_flips = 0;
  for (int i = 0; i < 34 / checks::effort + 17; ++i) {
    const int bits = i % 17;
    const GridMesh mesh(random, 0.8);
    std::map<Pixel, int> signed_count, unsigned_count, flipped;
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto corner = [&](int k) { return snap(mesh.corners[k][0], mesh.corners[k][1], bits); };
      const auto t = GridTriangle::of({corner(a), corner(b), corner(c)});
      if (!t) continue;
      // Unsnapped, every triangle that the shaking has not turned over is counter-clockwise; what
      // matters is the snapped orientation.
      flips += !t->counter_clockwise();
      for (std::int64_t y = 0; y < 16; ++y)
        for (std::int64_t x = 0; x < 16; ++x)
          if (t->covers(sample_of({x, y}))) {
            signed_count[{x, y}] += t->counter_clockwise() ? 1 : -1;
            ++unsigned_count[{x, y}];
            if (!t->counter_clockwise()) flipped[{x, y}] = 1;
          }
    }
    // The outline, 15.3 snapped, goes through no centre at 0.5 steps: 15 centres or 16 inside.
    const double side = static_cast<double>(snap(15.3, bits)) / grid_one;
    for (std::int64_t y = 0; y < 16; ++y)
      for (std::int64_t x = 0; x < 16; ++x) {
        const bool in = x + 0.5 < side && y + 0.5 < side;
        ASSERT_EQ((signed_count[{x, y}]), in) << bits << " bits at " << x << " " << y;
        if (!flipped.contains({x, y})) {
          ASSERT_EQ((unsigned_count[{x, y}]), in);
        }
        samples_with_flips += flipped.contains({x, y});
      }
  }
  EXPECT_GT(flips, 0);  // the case is there to be seen
  EXPECT_GT(samples_with_flips, 0);
}

TEST(SubpixelGrid, FloatingPointEdgeFunctionsLeaveCracksOrOverlaps) {
  // The same law broken: binary32 edge functions of corners far from the origin.
  std::mt19937_64 random(78);
  int wrong = 0;
  for (int i = 0; i < 20; ++i) {
    const GridMesh mesh(random, 0.8);
    std::map<Pixel, int> count;
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto corner = [&](int k) {
        return Point<float>{static_cast<float>(mesh.corners[k][0] + 60000),
                            static_cast<float>(mesh.corners[k][1] + 60000)};
      };
      rasterize_triangle<float>({corner(a), corner(b), corner(c)}, {},
                                [&](const auto& covered) { ++count[covered.pixel]; });
    }
    for (std::int64_t y = 60001; y < 60014; ++y)
      for (std::int64_t x = 60001; x < 60014; ++x) wrong += count[{x, y}] != 1;
  }
  EXPECT_GT(wrong, 0);
}

}  // namespace
}  // namespace fathom::pipeline
