// docs/sources.md: for each error of the source texts the wrong version, which fails, beside the
// right one, which is what the library computes. Error 25 is of a clipper: tests/clipping.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fathom/clipping/cohen_sutherland.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/homogeneous.h"
#include "fathom/depth_format/encode.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/pipeline/scan/area_fill.h"
#include "fathom/pipeline/scan/edge_function.h"
#include "fathom/pipeline/scan/line-inl.h"
#include "fathom/pipeline/trace.h"

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

double their_edge(const std::array<double, 2>& a, const std::array<double, 2>& b,
                  const std::array<double, 2>& p) {
  return (p[0] - a[0]) * (b[1] - a[1]) - (p[1] - a[1]) * (b[0] - a[0]);
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

/// The source's loop over the pixels of a box, which returns how many it drew, or nothing.
std::optional<int> their_fragments(const std::array<std::array<double, 2>, 3>& t, int width,
                                   int height) {
  if (std::abs(their_edge(t[0], t[1], t[2])) < 1e-10) return std::nullopt;  // the bare `return`
  int fragments = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::array<double, 2> p{x + 0.5, y + 0.5};
      fragments += their_edge(t[1], t[2], p) >= 0 && their_edge(t[2], t[0], p) >= 0 &&
                   their_edge(t[0], t[1], p) >= 0;
    }
  return fragments;
}

Scene scene_of(std::vector<MeshPoint> vertices, std::vector<CornerIndices> triangles) {
  Scene scene;
  scene.meshes.emplace_back();
  scene.meshes[0].vertices = std::move(vertices);
  scene.meshes[0].triangles = std::move(triangles);
  scene.objects.push_back({});
  return scene;
}

/// Pixels are units of the world: an orthographic look along z.
Camera window_camera(std::uint32_t width, std::uint32_t height) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection.model = ProjectionModel::orthographic;
  camera.near = 0;
  camera.far = 1;
  return camera;
}

TEST(Errata, E13_NoFragmentsAreACountToo) {
  // Its sum of both triangles' fragments needs two counts; of a line of corners it has none.
  EXPECT_FALSE(their_fragments({{{0, 0}, {4, 4}, {8, 8}}}, 8, 8));
  const std::vector<MeshPoint> v{{0, 0, 0.5}, {4, 4, 0.5}, {8, 8, 0.5}, {8, 0, 0.5}, {0, 8, 0.5}};
  const auto count = [&](std::vector<CornerIndices> triangles) {
    return render_frame(scene_of(v, std::move(triangles)), window_camera(8, 8), {}, false)
        .statistics;
  };
  EXPECT_EQ(count({{0, 1, 2}}).fragments, 0u);
  EXPECT_EQ(count({{0, 1, 2}}).degenerate, 1u);
  const auto alone = count({{0, 3, 4}}).fragments;
  EXPECT_GT(alone, 20u);
  EXPECT_EQ(count({{0, 1, 2}, {0, 3, 4}}).fragments, alone);  // and what follows is drawn
}

TEST(Errata, E14_WindowDepthIsAffineAndNotDividedAgain) {
  // From w = 1 on the left to w = 4, eight pixels away, on the right, with near 1: window depth is
  // 1 − 1/w, 0 to 3/4. Half way there 1/w is 5/8 and z = 3/8, the mean of the ends. With 1/w again
  // it would be (0 + 3/4/4)/(5/4) = 3/20. Another triangle lies at window depth 1/4, w = 4/3.
  Camera camera;  // the image at w = 1 is x and y
  camera.width = camera.height = 16;
  camera.projection.fx = camera.projection.fy = 1;
  camera.projection.cx = camera.projection.cy = 0;
  camera.near = 1;
  camera.far = 1000;
  const auto corner = [](double x, double y, double w) { return MeshPoint{x * w, y * w, w}; };
  const Scene scene =
      scene_of({corner(0.5, 0.5, 1), corner(8.5, 0.5, 4), corner(0.5, 8.5, 1),
                corner(0.25, 0.25, 4. / 3), corner(15, 0.25, 4. / 3), corner(0.25, 15, 4. / 3)},
               {{0, 1, 2}, {3, 4, 5}});
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.subpixel_bits = 16;
  options.depth_format.mapping = Mapping::infinite;
  const Pixel middle{4, 1};  // its centre: half way from the left side to the right corner
  const auto trace = trace_triangle(scene, camera, options, 0, middle);
  ASSERT_TRUE(trace.sample && trace.sample->covered);
  // Rounded a few dozen times in binary64.
  EXPECT_NEAR(trace.sample->window_z, 3. / 8, 1e-12);
  EXPECT_NEAR(trace.sample->depth, 8. / 5, 1e-12);
  // Right: the slanted triangle is in front up to a third of the way. Wrong: up to two thirds.
  const PipelineFrame frame = render_frame(scene, camera, options, false);
  for (std::uint32_t x = 1; x <= 6; ++x) {
    const double part = x / 8.0, z0 = 0, z1 = 0.75;
    const double right = z0 + part * (z1 - z0);
    const double wrong = (part * z1 / 4) / (1 - part + part / 4);
    EXPECT_EQ(frame.id[16 + x], right < 0.25 ? 0u : 1u) << x;
    if (3 <= x && x <= 5) {
      EXPECT_NE(right < 0.25, wrong < 0.25) << x;
    }
  }
}

/// The triangles of the demo, in this order: 1 is the near one, 2 the far one.
Scene demo_scene(std::vector<CornerIndices> triangles) {
  return scene_of({{80, 30, 0.3},
                   {30, 200, 0.3},
                   {200, 180, 0.3},
                   {160, 20, 0.6},
                   {100, 220, 0.6},
                   {290, 150, 0.6}},
                  std::move(triangles));
}
constexpr CornerIndices near_triangle{0, 1, 2}, far_triangle{3, 4, 5};

Camera demo_camera() {
  Camera camera = window_camera(320, 240);
  camera.near = 0.1;
  return camera;
}

TEST(Errata, E15_TheDemosCounts) {
  const Scene demo = demo_scene({far_triangle, near_triangle});
  PipelineOptions options;
  options.precision = Precision::binary64;
  const Camera camera = demo_camera();
  const PipelineFrame frame = render_frame(demo, camera, options, true);
  const auto covered = static_cast<std::uint64_t>(
      std::count_if(frame.id.begin(), frame.id.end(), [](auto id) { return id != no_surface; }));
  // Far first: all fragments pass the depth test. What the demo counts as passed is the union.
  EXPECT_EQ(frame.statistics.depth_passed, frame.statistics.fragments);
  EXPECT_LT(covered, frame.statistics.depth_passed);
  // 8 bit colours: truncation darkens.
  EXPECT_EQ(static_cast<int>(0.999 * 255), 254);
  EXPECT_EQ(to_rgb({1, 1, {{0.999, 0, 0}}}).pixels[0][0], 255);
}

TEST(Errata, E15_TheDemosNames) {
  // "Triangle 1 (far)" is printed beside the count of the one drawn first, which is its triangle 2.
  const std::array<std::array<double, 2>, 3> near_one{{{80, 30}, {30, 200}, {200, 180}}},
      far_one{{{160, 20}, {100, 220}, {290, 150}}};
  const std::array<std::optional<int>, 2> theirs{their_fragments(far_one, 320, 240),
                                                 their_fragments(near_one, 320, 240)};
  EXPECT_EQ(theirs[0], 16970);
  EXPECT_EQ(theirs[1], 13955);
  PipelineOptions options;
  options.precision = Precision::binary64;
  const auto frame_of = [&](std::vector<CornerIndices> triangles) {
    return render_frame(demo_scene(std::move(triangles)), demo_camera(), options, false);
  };
  EXPECT_EQ(frame_of({near_triangle}).statistics.fragments, 13955u);
  EXPECT_EQ(frame_of({far_triangle}).statistics.fragments, 16830u);
  // Triangle numbers are those of the file, in whatever order they are drawn.
  for (const bool near_first : {false, true}) {
    options.draw_order = near_first ? DrawOrder::front_to_back : DrawOrder::back_to_front;
    const PipelineFrame frame = frame_of({near_triangle, far_triangle});
    const auto at = [&](std::size_t x, std::size_t y) { return 320 * y + x; };
    EXPECT_EQ(frame.id[at(60, 160)], 0u);   // the near one alone
    EXPECT_EQ(frame.id[at(240, 130)], 1u);  // the far one alone
    EXPECT_EQ(frame.id[at(130, 150)], 0u);  // both
    EXPECT_EQ(std::count(frame.id.begin(), frame.id.end(), 0u), 13955);
  }
}

TEST(Errata, E15_AFragmentAtTheFarEndIsSeen) {
  const Scene scene = scene_of({{0, 0, 1}, {8, 0, 1}, {0, 8, 1}}, {{0, 1, 2}});
  Camera camera = window_camera(8, 8);
  camera.near = 0.5;
  const PipelineFrame frame = render_frame(scene, camera, {}, false);
  EXPECT_EQ(frame.id[0], 0u);  // stored depth 1.0:
  EXPECT_FALSE(1.0f < 1.0f);   // against a buffer cleared to 1.0 it would fail
}

TEST(Errata, E16_OrderIndependenceEndsWithTies) {
  const std::vector<MeshPoint> v{{0, 0, 0.5},      {8, 0, 0.5},      {0, 8, 0.5},
                                 {0, 0, 0.500001}, {8, 0, 0.500001}, {0, 8, 0.500001}};
  PipelineOptions options;
  options.depth_format.storage = Storage::unorm16;
  Camera camera = window_camera(8, 8);
  camera.near = 0.1;
  const auto winner = [&](CornerIndices first, CornerIndices second) {
    const Scene scene = scene_of(v, {first, second});
    return scene.meshes[0].triangles[render_frame(scene, camera, options, false).id[0]][0];
  };
  EXPECT_NE(winner({0, 1, 2}, {3, 4, 5}), winner({3, 4, 5}, {0, 1, 2}));
  options.depth_format.storage = Storage::float64;
  options.precision = Precision::binary64;
  EXPECT_EQ(winner({0, 1, 2}, {3, 4, 5}), winner({3, 4, 5}, {0, 1, 2}));
}

TEST(Errata, E17_TenThousandthOfWindowDepthIsNoFight) {
  // Window depth is z − 1, for an orthographic look from 1 to 2. Six or seven codes lie between two
  // sheets that far apart in it, anywhere, so either order of drawing shows the nearer one.
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.depth_format.storage = Storage::unorm16;
  Camera camera = window_camera(8, 8);
  camera.near = 1;
  camera.far = 2;
  const DepthFormat window{Mapping::linear, Storage::unorm16, 1, 2, 1};
  const auto code_of = [&](double z) {
    return static_cast<int>(encode(window, Ratio(Dyadic(z))).bits);
  };
  for (const double z : {1.0, 1.25, 1.5, 1.75, 1.9998}) {
    EXPECT_GE(code_of(z + 0.0001) - code_of(z), 6) << z;
    EXPECT_LE(code_of(z + 0.0001) - code_of(z), 7) << z;
    for (const bool near_first : {false, true}) {
      const Scene sheets = scene_of({{0, 0, z},
                                     {8, 0, z},
                                     {0, 8, z},
                                     {0, 0, z + 0.0001},
                                     {8, 0, z + 0.0001},
                                     {0, 8, z + 0.0001}},
                                    near_first ? std::vector<CornerIndices>{{0, 1, 2}, {3, 4, 5}}
                                               : std::vector<CornerIndices>{{3, 4, 5}, {0, 1, 2}});
      const PipelineFrame frame = render_frame(sheets, camera, options, false);
      const std::uint32_t farther = near_first ? 1 : 0;
      EXPECT_EQ(std::count(frame.id.begin(), frame.id.end(), farther), 0) << z;
    }
  }
  // Along the view, at depth 50 with near 0.1: the same code.
  const DepthFormat format{Mapping::standard, Storage::unorm16, 0.1, 100, 1};
  EXPECT_EQ(encode(format, Ratio(Dyadic(50.0))), encode(format, Ratio(Dyadic(50.0001))));
}

TEST(Errata, E18_TheRotatedGridsMeanIsTheCentre) {
  const double wrong_x = -0.25 + 0.25 - 0.125 + 0.375;
  EXPECT_EQ(wrong_x / 4, 1.0 / 16);
  EXPECT_EQ(sample_pattern("rotated-grid").offsets,
            (std::vector<SampleOffset>{
                {-0.375, -0.125}, {0.125, -0.375}, {-0.125, 0.375}, {0.375, 0.125}}));
  for (const char* n : {"1", "2", "4", "8", "rotated-grid"}) {
    GridPoint sum;
    const GridSamples pattern = GridSamples::of(sample_pattern(n));
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      sum.x += pattern.at({0, 0}, i).x;
      sum.y += pattern.at({0, 0}, i).y;
    }
    EXPECT_EQ(sum, (GridPoint{0, 0})) << n;
  }
}

TEST(Errata, E19_TheFallbacksCountAndSpacing) {
  const auto their_count = [](int samples) {
    const int n = static_cast<int>(std::sqrt(samples));
    return n * n;
  };
  EXPECT_EQ(their_count(2), 1);
  EXPECT_EQ(their_count(8), 4);
  EXPECT_EQ(sample_pattern("2").count(), 2u);
  EXPECT_EQ(sample_pattern("8").count(), 8u);
  // 1/(n+1) apart the samples of neighbouring pixels are 2/3 apart, those of a pixel 1/3.
  const GridSamples grid = GridSamples::regular(2);
  EXPECT_EQ(grid.at({0, 0}, 1).x - grid.at({0, 0}, 0).x, grid_one / 2);
}

/// What the source's program leaves of white triangles at one depth over black: it blends by the
/// share of samples, and keeps one depth for each pixel.
std::array<std::array<double, 8>, 8> their_multisampling(
    const std::vector<std::array<std::array<double, 2>, 3>>& triangles) {
  std::array<std::array<double, 8>, 8> colours{}, depths{};
  for (auto& row : depths) row.fill(1);
  for (const auto& [a, b, c] : triangles)
    for (std::size_t y = 0; y < 8; ++y)
      for (std::size_t x = 0; x < 8; ++x) {
        double coverage = 0;
        for (const auto& [u, v] : {std::pair(-0.25, -0.125), std::pair(0.25, -0.375),
                                   std::pair(-0.125, 0.375), std::pair(0.375, 0.125)}) {
          const std::array<double, 2> p{static_cast<double>(x) + 0.5 + u,
                                        static_cast<double>(y) + 0.5 + v};
          if (their_edge(b, c, p) >= 0 && their_edge(c, a, p) >= 0 && their_edge(a, b, p) >= 0)
            coverage += 0.25;
        }
        if (coverage == 0 || !(0.5 < depths[y][x])) continue;  // the depth test of set_pixel()
        depths[y][x] = 0.5;
        colours[y][x] = coverage + colours[y][x] * (1 - coverage);
      }
  return colours;
}

TEST(Errata, E20_BlendingCoverageLeavesASeam) {
  // Two triangles, each with half of the samples of a pixel on the diagonal, over black. The second
  // one, as deep as the first, fails the source's depth test: half of the black stays.
  const auto theirs = their_multisampling({{{{0, 0}, {8, 8}, {8, 0}}}, {{{0, 0}, {0, 8}, {8, 8}}}});
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(theirs[i][i], 0.5);
  EXPECT_EQ(theirs[1][5], 1);
  const Scene square =
      scene_of({{0, 0, 0.5}, {8, 0, 0.5}, {8, 8, 0.5}, {0, 8, 0.5}}, {{0, 1, 2}, {0, 2, 3}});
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.shading = Shading::none;
  options.antialias = {AntialiasMethod::msaa, 4};
  Camera camera = window_camera(8, 8);
  camera.near = 0.1;
  const PipelineFrame frame = render_frame(square, camera, options, true);
  for (int i = 0; i < 8; ++i)
    EXPECT_NEAR(frame.picture.at(i, i)[0], 1, 1e-7);  // floats hold colours
}

TEST(Errata, E20_AnUncoveredCentreIsNoPlaceToShade) {
  // Red falls from 1 at the corner to 0 on the long side, x + y = 7.75, which leaves the centres of
  // the diagonal outside, and of their samples the one with the least x + y inside.
  Scene scene = scene_of({{0, 0, 0.5}, {7.75, 0, 0.5}, {0, 7.75, 0.5}}, {{0, 1, 2}});
  scene.meshes[0].colours = {{1, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0, 1}};
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.shading = Shading::none;
  options.background = {0, 0, 0};
  options.antialias = {AntialiasMethod::msaa, 4};
  Camera camera = window_camera(8, 8);
  camera.near = 0.1;
  const PipelineFrame frame = render_frame(scene, camera, options, true);
  const double at_centre = 1 - 8 / 7.75, at_sample = 1 - 7.5 / 7.75;
  EXPECT_LT(at_centre, 0);
  for (std::uint32_t i = 0; i < 8; ++i)
    EXPECT_NEAR(frame.picture.at(i, 7 - i)[0], at_sample / 4, 1e-7) << i;
}

TEST(Errata, E21_JitterIsForRegularPatterns) {
  // A grating of just under one line a pixel: samples at centres see slow false stripes, all jitter
  // leaves of them is noise. The false stripe has a period of 20 pixels.
  const auto grating = [](double x) { return std::fmod(x * 1.05, 1.0) < 0.5 ? 1.0 : 0.0; };
  const auto stripe = [&](const auto& sample_x) {
    double c = 0, s = 0;
    for (int x = 0; x < 400; ++x) {
      double mean = 0;
      for (int k = 0; k < 4; ++k) mean += grating(x + sample_x(x, k)) / 4;
      c += mean * std::cos(x * 0.05 * 2 * std::acos(-1.0));
      s += mean * std::sin(x * 0.05 * 2 * std::acos(-1.0));
    }
    return std::hypot(c, s) / 400;
  };
  const GridSamples jitter = GridSamples::of(sample_pattern("jittered:2"));
  const double regular = stripe([](int, int) { return 0.5; });
  const double jittered = stripe([&](int x, int k) {
    return 0.5 + static_cast<double>(jitter.at({x, 0}, static_cast<std::size_t>(k)).x) / grid_one;
  });
  EXPECT_GT(regular, 0.3);
  EXPECT_LT(jittered, regular / 3);
}

TEST(Errata, E22_TheProjectionOfAPointBehindTheEye) {
  Camera camera = window_camera(8, 8);
  camera.projection.model = ProjectionModel::perspective;
  camera.near = 1;
  camera.far = 2;
  PipelineOptions options;
  options.depth_format.mapping = Mapping::opengl;
  fill_in_range({}, camera, options.depth_format);
  const VertexTransform<double> transform(camera, {}, options);
  // The frame of the source, z backward: (0, 0, n) is behind the eye.
  const auto clip = transform.to_clip({0, 0, 1});
  EXPECT_EQ(clip.z, -7);
  EXPECT_EQ(clip.w, -1);
  // 3 = (f + n)/(f − n) bounds z/w from below, for points behind the eye; none of them has it.
  double before = 1e300;
  for (const double z : {0.125, 1.0, 8.0, 64.0, 4096.0}) {
    const auto p = transform.to_clip({0, 0, z});
    EXPECT_GT(p.z / p.w, 3);
    EXPECT_LT(p.z / p.w, before);
    before = p.z / p.w;
  }
  EXPECT_LT(before, 3.001);
}

TEST(Errata, E23_TheSignInTheHomogeneousIntersection) {
  // R = (3, 0, 0, 1), S = (0, 0, 0, 2) and the plane x = w: x(t) − w(t) = 2 + t(−3 − 1).
  using clipping::Rational;
  const clipping::Segment4<Rational> segment{{3, 0, 0, 1}, {0, 0, 0, 2}};
  clipping::LiangBarskyTrace<Rational> trace;
  const auto part = clipping::clip_homogeneous(segment, clipping::Volume::zero_one,
                                               clipping::Half::upper, &trace);
  ASSERT_TRUE(part);
  EXPECT_EQ(trace.t_entering, Rational(1, 2));
  EXPECT_EQ(trace.t_leaving, Rational(1));
  EXPECT_EQ(part->start.x, Rational(3, 2));
  EXPECT_EQ(part->start.w, Rational(3, 2));
  // The source's x(t) − w(t) = R_x − R_w + t((S_w − R_w) − (S_x − R_x)) is 0 at −½, and not there.
  const Rational t = trace.t_entering, rx = 3, rw = 1, sx = 0, sw = 2;
  EXPECT_EQ(rx - rw + t * ((sx - rx) - (sw - rw)), 0);
  EXPECT_EQ(rx - rw + t * ((sw - rw) - (sx - rx)), 4);
}

TEST(Errata, E24_ASharedOutcodeIsTestTwo) {
  // From the left of the window to above it, past its corner.
  using clipping::Rational;
  const clipping::Segment2<Rational> D{{-1, 3}, {1, 9}};
  const clipping::Window<Rational> window{0, 0, 4, 4};
  std::vector<clipping::CohenSutherlandStep<Rational>> trace;
  EXPECT_FALSE(clipping::cohen_sutherland(D, window, &trace));
  ASSERT_EQ(trace.size(), 2u);
  EXPECT_EQ(clipping::to_bits(trace[0].E1), "0001");  // left: the source has 0010
  EXPECT_EQ(clipping::to_bits(trace[0].E2), "1000");
  EXPECT_EQ(trace[0].test, 4);
  // E3 = (0, 6) and E2 share the top: the source says test 4.
  EXPECT_EQ(trace[1].segment.start, (clipping::Point2<Rational>{0, 6}));
  EXPECT_EQ(trace[1].E1 & trace[1].E2, clipping::outcode::top);
  EXPECT_EQ(trace[1].test, 2);
}

std::vector<double> facing_shares(bool closed) {
  // A cube, or an open box: its front removed.
  std::vector<MeshPoint> v;
  for (int i = 0; i < 8; ++i) v.push_back({i & 1 ? 1. : -1., i & 2 ? 1. : -1., i & 4 ? 5. : 3.});
  std::vector<CornerIndices> t{{4, 5, 7}, {4, 7, 6}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7},
                               {1, 7, 5}, {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3}};
  if (closed) t.push_back({0, 2, 3}), t.push_back({0, 3, 1});
  const Scene scene = scene_of(v, t);
  Camera camera;
  camera.width = camera.height = 64;
  camera.projection.fx = camera.projection.fy = 64;
  camera.projection.cx = camera.projection.cy = 32;
  camera.near = 1;
  camera.far = 10;
  PipelineOptions options;
  const auto none = render_frame(scene, camera, options, false);
  options.culling = Culling::back;
  const auto back = render_frame(scene, camera, options, false);
  double different = 0;
  for (std::size_t i = 0; i < none.id.size(); ++i)
    different += (none.id[i] == no_surface) != (back.id[i] == no_surface);
  return {different, static_cast<double>(back.statistics.culled)};
}

TEST(Errata, E26_CullingNeedsAClosedSurface) {
  EXPECT_EQ(facing_shares(true)[0], 0);   // closed: nothing is missing
  EXPECT_GT(facing_shares(false)[0], 0);  // open: a hole, however convex
  // 10 of 12 faces of the cube are culled from straight ahead: half is an average.
  EXPECT_EQ(facing_shares(true)[1], 10);
}

TEST(Errata, E27_NormalInNdcAndDeterminantAreTheSameNumber) {
  const std::array<NdcVertex<double>, 3> t{
      {{-0.5, -0.5, 0.1, 1, {}}, {0.5, -0.5, 0.7, 1, {}}, {0, 0.5, 0.2, 1, {}}}};
  const double n_z = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x);
  EXPECT_GT(n_z, 0);  // "positive: remove" would remove this front face
  EXPECT_EQ(facing_in_ndc(t, FrontFace::counter_clockwise), Facing::front);
}

TEST(Errata, E28_CullingAfterTheDivisionSeesWhatIsDrawn) {
  // Of a triangle with a corner behind the eye, the signed area of the divided corners is that of
  // another triangle; clipping comes first.
  std::vector<ClipVertex<double>> t;
  for (const auto& [x, y, w] : {std::array{-1., -1., 2.}, {1., -1., 2.}, {0., 3., -1.}})
    t.push_back({{x, y, w > 0 ? 1. : -2., w}, std::vector<double>(attribute::count)});
  const auto area = [](const auto& v) {
    return (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[2].x - v[0].x) * (v[1].y - v[0].y);
  };
  std::vector<NdcVertex<double>> wrong, right;
  for (const auto& corner : t) wrong.push_back(divide(corner));
  for (const auto& corner : clip_triangle(t, clipping::Volume::zero_one))
    right.push_back(divide(corner));
  ASSERT_GE(right.size(), 3u);
  EXPECT_LT(area(wrong), 0);
  EXPECT_GT(area(right), 0);
  // The stage itself: the same triangle, y down, keeps every pixel when back faces are culled, and
  // loses all of them when it is turned.
  Camera camera = window_camera(64, 64);
  camera.projection.model = ProjectionModel::perspective;
  camera.projection.fx = camera.projection.fy = camera.projection.cx = camera.projection.cy = 32;
  camera.near = 0.5;
  camera.far = 10;
  const auto pixels = [&](CornerIndices corners, Culling culling) {
    PipelineOptions options;
    options.culling = culling;
    const Scene scene = scene_of({{-1, 1, 2}, {1, 1, 2}, {0, -3, -1}}, {corners});
    const PipelineFrame frame = render_frame(scene, camera, options, false);
    EXPECT_EQ(frame.statistics.clipped, 1u);
    return std::count(frame.id.begin(), frame.id.end(), 0u);
  };
  const auto all = pixels({0, 1, 2}, Culling::none);
  EXPECT_GT(all, 500);
  EXPECT_EQ(pixels({0, 1, 2}, Culling::back), all);
  EXPECT_EQ(pixels({0, 1, 2}, Culling::front), 0);
  EXPECT_EQ(pixels({0, 2, 1}, Culling::back), 0);
  EXPECT_EQ(pixels({0, 2, 1}, Culling::front), all);
}

TEST(Errata, E29_OneViewDirectionIsWrongInPerspective) {
  // A face to the side, turned a little away from the axis, but towards the eye.
  const std::array<WorldVertex<double>, 3> t{{{4, 0, 4}, {4.2, 0, 6}, {4, 1, 4}}};
  const auto eye = facing_in_world(t, {0, 0, 0}, true, false, FrontFace::counter_clockwise);
  const auto fixed = facing_in_world(t, {0, 0, -1}, false, false, FrontFace::counter_clockwise);
  EXPECT_NE(eye, fixed);
}

TEST(Errata, E30_SortingByTheFarthestCornerAloneIsWrong) {
  // A small triangle before a large slanted one that begins nearer and ends farther.
  const Scene scene =
      scene_of({{-4, -4, 2}, {4, -4, 2}, {0, 6, 9}, {-1, 0, 6}, {1, 0, 6}, {0, -1, 6.5}},
               {{3, 4, 5}, {0, 1, 2}});
  Camera camera;
  camera.width = camera.height = 64;
  camera.projection.fx = camera.projection.fy = 64;
  camera.projection.cx = camera.projection.cy = 32;
  camera.near = 1;
  camera.far = 20;
  PipelineOptions options;
  options.precision = Precision::binary64;
  const PipelineFrame buffer = render_frame(scene, camera, options, false);
  options.hidden_surface = HiddenSurface::painter;
  const PipelineFrame painter = render_frame(scene, camera, options, false);
  EXPECT_EQ(buffer.id, painter.id);
  EXPECT_GT(painter.painter.comparisons, 0u);  // zmax alone does not settle it
}

TEST(Errata, E31_TheTablesContradictThemselves) {
  // A triangle whose coverage at pixel centres is the black one of the 12-column tables: its sides
  // are x = 5.4 − k/2 and x = 5.8 + 3k/5 at the centre of row k.
  const double top = -4. / 11;
  const auto at = [](double k, double x) { return MeshPoint{x, k + 0.5, 0.5}; };
  const Scene scene = scene_of({at(top, 5.4 - top / 2), at(20, 17.8), at(20, -4.6)}, {{0, 1, 2}});
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.shading = Shading::none;
  options.background = {0, 0, 0};
  Camera camera = window_camera(12, 9);
  camera.near = 0.125;
  const PipelineFrame frame = render_frame(scene, camera, options, true);
  const auto row = [&](std::size_t y, const auto& word) {
    std::string words;
    for (std::size_t x = 0; x < 12; ++x) words += (x ? " " : "") + std::string(word(12 * y + x));
    return words;
  };
  const auto depth = [&](std::size_t y) {
    return row(y, [&](std::size_t i) { return frame.depth[i] == 0.5F ? ".5" : "1.0"; });
  };
  const auto colour = [&](std::size_t y) {
    return row(y, [&](std::size_t i) { return frame.picture.pixels[i][0] > 0.5F ? "B" : "W"; });
  };
  // Row 7 of the source, and those beside it, which do agree.
  EXPECT_EQ(depth(5), "1.0 1.0 1.0 .5 .5 .5 .5 .5 .5 1.0 1.0 1.0");
  EXPECT_EQ(colour(5), "W W W B B B B B B W W W");
  EXPECT_EQ(depth(6), "1.0 1.0 .5 .5 .5 .5 .5 .5 .5 1.0 1.0 1.0");
  EXPECT_EQ(colour(6), "W W B B B B B B B W W W");
  EXPECT_NE(colour(6), "W W B B B B B B B B W W");  // its colours
  EXPECT_EQ(depth(7), "1.0 1.0 .5 .5 .5 .5 .5 .5 .5 .5 1.0 1.0");
  EXPECT_EQ(colour(7), "W W B B B B B B B B W W");
}

TEST(Errata, E32_TheDeterminantsLastFactor) {
  // (x2−x1)(y3−y1) − (x3−x1)(y3−y1) has another sign for many a triangle.
  int different = 0;
  for (int i = 0; i < 5 * 5 * 5 * 5; ++i) {
    const int x2 = i % 5 - 2, y2 = i / 5 % 5 - 2, x3 = i / 25 % 5 - 2, y3 = i / 125 - 2;
    const int wrong = x2 * y3 - x3 * y3, right = x2 * y3 - x3 * y2;
    const Facing facing = right > 0 ? Facing::front : right < 0 ? Facing::back : Facing::edge_on;
    const Facing theirs = wrong > 0 ? Facing::front : wrong < 0 ? Facing::back : Facing::edge_on;
    std::array<NdcVertex<double>, 3> ndc{};
    ndc[0].x = ndc[0].y = 0.5;  // nothing depends on where x1 and y1 are
    ndc[1] = {0.5 + x2, 0.5 + y2, 0, 1, {}};
    ndc[2] = {0.5 + x3, 0.5 + y3, 0, 1, {}};
    EXPECT_EQ(facing_in_ndc(ndc, FrontFace::counter_clockwise), facing);
    std::array<WindowVertex<double>, 3> window{};  // y down
    for (std::size_t k = 0; k < 3; ++k) window[k] = {ndc[k].x, -ndc[k].y, 0, 1, {}};
    EXPECT_EQ(facing_in_window(window, FrontFace::counter_clockwise), facing);
    different += facing != theirs;
  }
  EXPECT_GT(different, 100);
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
