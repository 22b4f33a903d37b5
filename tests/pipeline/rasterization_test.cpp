// Triangles on the grid and lines in the window against definitions: products of differences, and
// the nearest points of segments.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/pipeline/rasterization/rasterizer.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/pipeline/scan/diamond_exit.h"
#include "fathom/pipeline/scan/edge_function.h"
#include "fathom/pipeline/trace.h"
#include "tests/inputs/scene_building.h"

namespace fathom::pipeline {
namespace {

/// Twice the area of p, q, r: positive if they run clockwise as seen, y down.
std::int64_t turn(const GridPoint& p, const GridPoint& q, const GridPoint& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

/// The specification's rule: strictly inside, or on an edge whose inward normal points to the right
/// or, for a level edge, down.
bool is_covered(const std::array<GridPoint, 3>& t, const GridPoint& s) {
  const bool clockwise = turn(t[0], t[1], t[2]) > 0;
  for (std::size_t k = 0; k < 3; ++k) {
    GridPoint a = t[k], b = t[(k + 1) % 3];
    if (!clockwise) std::swap(a, b);
    const std::int64_t side = turn(a, b, s);
    if (side < 0) return false;
    const std::int64_t right = a.y - b.y, down = b.x - a.x;  // the inward normal
    if (side == 0 && !(right > 0 || (right == 0 && down > 0))) return false;
  }
  return true;
}

std::array<GridPoint, 3> random_triangle(std::mt19937_64& random) {
  // Corners at multiples of a quarter of a pixel, from 6 pixels before to 12 after the origin: ties
  // abound.
  const auto at = [&] { return (static_cast<std::int64_t>(random() % 72) - 24) * (grid_one / 4); };
  std::array<GridPoint, 3> t;
  for (GridPoint& p : t) p = {at(), at()};
  return t;
}

TEST(GridTriangle, CoversWhatTheDefinitionSays) {
  std::mt19937_64 random(41);
  int full = 0, empty_rows = 0;
  for (int i = 0; i < 1500; ++i) {
    const auto corners = random_triangle(random);
    const auto t = GridTriangle::of(corners);
    const std::int64_t area = turn(corners[0], corners[1], corners[2]);
    ASSERT_EQ(t.has_value(), area != 0);
    if (!t) continue;
    EXPECT_EQ(t->counter_clockwise(), area < 0);
    EXPECT_TRUE(t->twice_area() == Int128{std::abs(area)});
    const PixelWindow box = t->bounding_box();
    const PixelWindow window{-3, -5, 9, 11};
    const std::int64_t dx = (static_cast<std::int64_t>(random() % 5) - 2) * (grid_one / 8);
    const std::int64_t dy = (static_cast<std::int64_t>(random() % 5) - 2) * (grid_one / 8);
    for (std::int64_t y = -8; y <= 14; ++y) {
      std::int64_t first = 100, end = -100;
      for (std::int64_t x = -8; x <= 14; ++x) {
        const GridPoint s = sample_of({x, y}, dx, dy);
        EXPECT_EQ(s.x, x * grid_one + grid_one / 2 + dx);
        const bool covered = is_covered(corners, s);
        ASSERT_EQ(t->covers(s), covered);
        const auto e = t->edges_at(s);
        ASSERT_TRUE(e[0] + e[1] + e[2] == t->twice_area());
        ASSERT_TRUE(e[0] == Int128{turn(corners[1], corners[2], s)} * (area > 0 ? 1 : -1));
        ASSERT_TRUE(e[2] == Int128{turn(corners[0], corners[1], s)} * (area > 0 ? 1 : -1));
        EXPECT_TRUE(!covered || box.contains({x, y}));
        if (!covered || x < window.x_begin || x >= window.x_end) continue;
        first = std::min(first, x);
        end = std::max(end, x + 1);
      }
      const Span span = t->span_of_row(y, window, dx, dy);
      ASSERT_EQ(span.y, y);
      if (first < end) {
        ASSERT_EQ(span.x_begin, first);
        ASSERT_EQ(span.x_end, end);
      } else {
        ASSERT_GE(span.x_begin, span.x_end);
        ++empty_rows;
      }
    }
    const auto [left, right] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [top, bottom] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    const auto pixel = [](std::int64_t x) {
      return static_cast<std::int64_t>(std::floor(static_cast<double>(x) / grid_one));
    };
    EXPECT_EQ(box, (PixelWindow{pixel(left), pixel(top), pixel(right) + 1, pixel(bottom) + 1}));
    // A block: what is said of all of it holds at each of its samples.
    for (std::int64_t y = -8; y < 16; y += 4) {
      for (std::int64_t x = -8; x < 16; x += 4) {
        const auto coverage = t->test_block({x, y}, 4);
        bool some_corner_outside = false;
        for (const GridPoint& c : {GridPoint{x, y}, {x + 4, y}, {x, y + 4}, {x + 4, y + 4}}) {
          const GridPoint at{c.x * grid_one, c.y * grid_one};
          for (std::size_t k = 0; k < 3; ++k) {
            const std::int64_t side = turn(corners[k], corners[(k + 1) % 3], at);
            some_corner_outside = some_corner_outside || (area > 0 ? side <= 0 : side >= 0);
          }
        }
        bool apart = false;  // all corners beyond one edge
        for (std::size_t k = 0; k < 3; ++k) {
          bool beyond = true;
          for (const GridPoint& c : {GridPoint{x, y}, {x + 4, y}, {x, y + 4}, {x + 4, y + 4}}) {
            const std::int64_t side =
                turn(corners[k], corners[(k + 1) % 3], {c.x * grid_one, c.y * grid_one});
            beyond = beyond && (area > 0 ? side < 0 : side > 0);
          }
          apart = apart || beyond;
        }
        using enum GridTriangle::BlockCoverage;
        ASSERT_EQ(coverage, apart ? none : some_corner_outside ? some : all);
        full += coverage == all;
      }
    }
  }
  EXPECT_GT(full, 40);
  EXPECT_GT(empty_rows, 1000);
}

TEST(Snap, IsTheNearestPositionOfTheGrid) {
  for (const int bits : {0, 1, 8, 16}) {
    const std::int64_t step = grid_one >> bits;
    for (const double x : {0.0, 0.25, 0.5, 1.5, -0.5, -2.75, 1000.123, 0.49999999, 3.0000076}) {
      const double places = x * std::ldexp(1, bits), below = std::floor(places);
      const bool up = places - below > 0.5 || (places - below == 0.5 && std::fmod(below, 2) != 0);
      EXPECT_EQ(snap(x, bits), static_cast<std::int64_t>(below + up) * step) << x << " " << bits;
    }
  }
  EXPECT_EQ(snap(1.5, -2.25, 8), (GridPoint{3 * grid_one / 2, -9 * grid_one / 4}));
}

/// 32 × 32 pixels; (x, y, 2) lies at 16 + 16·x, 16 + 16·y.
Camera camera_of_wires() {
  Camera camera = checks::camera_of(32, 32, 32);
  camera.near = 1;
  camera.far = 100;
  return camera;
}

PipelineOptions wires(WireLine line) {
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.depth_format.storage = Storage::float64;
  options.shading = Shading::wireframe;
  options.wire_line = line;
  return options;
}

struct Corner {
  double x, y, depth;  ///< in the window
  std::array<float, 3> colour;
};

MeshPoint place_of(const Corner& c) {
  return {(c.x - 16) / 32 * c.depth, (c.y - 16) / 32 * c.depth, c.depth};
}

/// What a line shows at a pixel: at its point that is nearest to the pixel's centre 1/w is affine
/// in the window, and colours over w too.
struct OnLine {
  double distance, depth;
  std::array<double, 3> colour;
};
OnLine on_line(const Corner& a, const Corner& b, double u, double v) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  double t = ((u - a.x) * dx + (v - a.y) * dy) / (dx * dx + dy * dy);
  t = std::clamp(t, 0.0, 1.0);
  const double inverse = (1 - t) / a.depth + t / b.depth;
  OnLine result{std::hypot(u - a.x - t * dx, v - a.y - t * dy), 1 / inverse, {}};
  for (std::size_t k = 0; k < 3; ++k) {
    result.colour[k] = ((1 - t) * static_cast<double>(a.colour[k]) / a.depth +
                        t * static_cast<double>(b.colour[k]) / b.depth) /
                       inverse;
  }
  return result;
}

TEST(Wireframe, LinesHaveTheDepthsAndColoursOfTheirNearestPoints) {
  std::mt19937_64 random(43);
  std::uniform_real_distribution<double> place(2, 30), depth(2, 9);
  std::uniform_real_distribution<float> unit(0, 1);
  for (int i = 0; i < 40; ++i) {
    std::array<Corner, 3> corners;
    for (Corner& c : corners) {
      c = {place(random), place(random), depth(random), {unit(random), unit(random), unit(random)}};
    }
    Scene scene = checks::scene_of(
        {place_of(corners[0]), place_of(corners[1]), place_of(corners[2])}, {{0, 1, 2}});
    for (const Corner& c : corners) {
      scene.meshes[0].colours.push_back({c.colour[0], c.colour[1], c.colour[2], 1});
    }
    for (const WireLine line : {WireLine::explicit_equation, WireLine::dda, WireLine::bresenham,
                                WireLine::midpoint, WireLine::diamond_exit}) {
      const PipelineFrame frame = render_frame(scene, camera_of_wires(), wires(line), true);
      std::size_t drawn = 0;
      for (std::uint32_t y = 0; y < 32; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) {
          const std::size_t at = y * 32 + x;
          if (frame.id[at] == no_surface) continue;
          ++drawn;
          // One of the three lines passes by; where several do, the nearest is seen.
          bool explained = false;
          for (std::size_t k = 0; k < 3; ++k) {
            const OnLine l = on_line(corners[k], corners[(k + 1) % 3], x + 0.5, y + 0.5);
            // Ends that are rounded to pixels move a line by up to 0.71 pixels, its own rounding by
            // ½.
            if (l.distance > 1.25) continue;
            bool same = std::abs(l.depth - static_cast<double>(frame.depth[at])) < 1e-5;
            for (std::size_t c = 0; c < 3; ++c) {
              same = same && std::abs(l.colour[c] - frame.picture.pixels[at][c]) < 1e-5;
            }
            explained = explained || same;
          }
          EXPECT_TRUE(explained) << i << ": " << x << " " << y;
        }
      }
      // A line of n pixels along its major axis has n pixels; three of them share corners.
      double length = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const Corner &a = corners[k], &b = corners[(k + 1) % 3];
        length += std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
      }
      EXPECT_LE(static_cast<double>(drawn), length + 6);
      EXPECT_GE(static_cast<double>(drawn), length / 3);
    }
  }
}

TEST(Wireframe, TheNearerOfTwoLinesIsSeenWhereTheyCross) {
  // A triangle whose long side rises to the right, and one whose falls; nearer or farther.
  for (const double other : {3.0, 7.0}) {
    const auto at = [](double x, double y, double z) { return place_of({x, y, z, {}}); };
    const Scene scene =
        checks::scene_of({at(4.5, 4.5, 5), at(28.5, 28.5, 5), at(4.5, 28.5, 5),
                          at(4.5, 28.5, other), at(28.5, 4.5, other), at(4.5, 4.5, other)},
                         {{0, 1, 2}, {3, 4, 5}});
    for (const auto order : {std::array{0u, 1u}, std::array{1u, 0u}}) {
      Scene ordered = scene;
      ordered.meshes[0].triangles = {scene.meshes[0].triangles[order[0]],
                                     scene.meshes[0].triangles[order[1]]};
      const PipelineFrame frame =
          render_frame(ordered, camera_of_wires(), wires(WireLine::bresenham), true);
      const std::uint32_t seen = frame.id[16 * 32 + 16];
      ASSERT_NE(seen, no_surface);
      EXPECT_EQ(order[seen], other < 5 ? 1u : 0u);
      EXPECT_NEAR(static_cast<double>(frame.depth[16 * 32 + 16]), std::min(other, 5.0), 1e-5);
      // Fragments are counted whether or not they are seen.
      EXPECT_GE(frame.statistics.fragments, frame.statistics.depth_passed);
      EXPECT_GT(frame.statistics.depth_passed, 60u);
    }
  }
}

TEST(Points, ShowTheirVertex) {
  const std::array<Corner, 3> corners{{{4.25, 20.75, 3, {1, 0.5, 0.25}},
                                       {20.5, 3.5, 6, {0.25, 0.125, 1}},
                                       {28.75, 28.25, 9, {0.5, 0.75, 0.125}}}};
  Scene scene = checks::scene_of({place_of(corners[0]), place_of(corners[1]), place_of(corners[2])},
                                 {{0, 1, 2}});
  for (const Corner& c : corners) {
    scene.meshes[0].colours.push_back({c.colour[0], c.colour[1], c.colour[2], 1});
  }
  PipelineOptions options = wires(WireLine::bresenham);
  options.shading = Shading::points;
  PipelineFrame frame = render_frame(scene, camera_of_wires(), options, true);
  EXPECT_EQ(frame.statistics.fragments, 3u);
  EXPECT_EQ(frame.statistics.depth_passed, 3u);
  for (const Corner& c : corners) {
    const std::size_t at =
        static_cast<std::size_t>(std::floor(c.y)) * 32 + static_cast<std::size_t>(std::floor(c.x));
    EXPECT_EQ(frame.id[at], 0u);
    EXPECT_NEAR(static_cast<double>(frame.depth[at]), c.depth, 1e-5);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(frame.picture.pixels[at][k], static_cast<double>(c.colour[k]), 1e-6);
    }
  }
  // Each side of the scissor cuts off one of them.
  const auto points_in = [&](const WindowRectangle& r) {
    options.scissor = r;
    return render_frame(scene, camera_of_wires(), options, true).statistics.fragments;
  };
  EXPECT_EQ(points_in({4, 0, 28, 32}), 3u);
  EXPECT_EQ(points_in({5, 0, 27, 32}), 2u);
  EXPECT_EQ(points_in({0, 0, 29, 32}), 3u);
  EXPECT_EQ(points_in({0, 0, 28, 32}), 2u);
  EXPECT_EQ(points_in({0, 3, 32, 29}), 3u);  // from below: row 28 is the fourth
  EXPECT_EQ(points_in({0, 4, 32, 28}), 2u);
  EXPECT_EQ(points_in({0, 0, 32, 29}), 3u);  // row 3 is the twenty-ninth from below
  EXPECT_EQ(points_in({0, 0, 32, 28}), 2u);
}

/// A traced triangle against its own definition.
TEST(Trace, SaysWhatEveryStageDid) {
  Scene scene = checks::scene_of({{-0.5, -0.5, 2}, {1.5, -1, 4}, {-0.3, 0.75, 3}, {9, 9, 9}},
                                 {{0, 1, 2}, {2, 1, 0}, {0, 2, 3}});
  scene.objects.push_back(scene.objects[0]);
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.subpixel_bits = 16;
  options.depth_format.storage = Storage::float64;
  const Pixel pixel{14, 14};
  const PrimitiveTrace trace = trace_triangle(scene, camera_of_wires(), options, 0, pixel);
  EXPECT_EQ(trace.near, 1);
  EXPECT_EQ(trace.far, 100);
  // u = 16 + 32·x/z: (8, 8), (28, 8), (12.8, 24); no centre lies on a side.
  const std::array<std::array<double, 3>, 3> window{{{8, 8, 2}, {28, 8, 4}, {12.8, 24, 3}}};
  ASSERT_EQ(trace.polygon.size(), 3u);
  std::array<GridPoint, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const MeshPoint& p = scene.meshes[0].vertices[k];
    EXPECT_EQ(trace.corners[k].mesh, (std::array{p.x, p.y, p.z}));
    EXPECT_EQ(trace.corners[k].world, (std::array{p.x, p.y, p.z}));
    EXPECT_EQ(trace.corners[k].eye, (std::array{p.x, -p.y, -p.z}));
    EXPECT_EQ(trace.corners[k].clip[3], p.z);
    EXPECT_EQ(trace.polygon[k].clip, trace.corners[k].clip);
    EXPECT_NEAR(trace.polygon[k].ndc[0], 2 * p.x / p.z, 1e-14);
    EXPECT_NEAR(trace.polygon[k].ndc[1], -2 * p.y / p.z, 1e-14);
    EXPECT_NEAR(trace.polygon[k].window[0], window[k][0], 1e-12);
    EXPECT_NEAR(trace.polygon[k].window[1], window[k][1], 1e-12);
    const double z = 100.0 / 99 * (1 - 1 / p.z);  // the standard mapping
    EXPECT_NEAR(trace.polygon[k].window[2], z, 1e-14);
    corners[k] = snap(window[k][0], window[k][1], 16);
    EXPECT_EQ(trace.polygon[k].snapped[0], static_cast<double>(corners[k].x) / grid_one);
    EXPECT_EQ(trace.polygon[k].snapped[1], static_cast<double>(corners[k].y) / grid_one);
  }
  std::uint64_t fragments = 0;
  for (std::int64_t y = 0; y < 32; ++y) {
    for (std::int64_t x = 0; x < 32; ++x) fragments += is_covered(corners, sample_of({x, y}));
  }
  EXPECT_EQ(trace.fragments, fragments);
  ASSERT_TRUE(trace.sample);
  EXPECT_TRUE(trace.sample->covered);
  const GridPoint s = sample_of(pixel);
  const double area = static_cast<double>(turn(corners[0], corners[1], corners[2]));
  double sum = 0, z = 0;
  std::array<double, 3> weights{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double edge = static_cast<double>(turn(corners[(k + 1) % 3], corners[(k + 2) % 3], s));
    EXPECT_DOUBLE_EQ(trace.sample->edges[k], edge / grid_one / grid_one);
    EXPECT_NEAR(trace.sample->weights[k], edge / area, 1e-14);
    weights[k] = edge / area / window[k][2];
    sum += weights[k];
    z += edge / area * trace.polygon[k].window[2];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(trace.sample->attribute_weights[k], weights[k] / sum, 1e-14);
  }
  EXPECT_NEAR(trace.sample->depth, 1 / sum, 1e-13);
  EXPECT_NEAR(trace.sample->window_z, z, 1e-14);
  EXPECT_EQ(trace.sample->stored.bits, store(Storage::float64, trace.sample->window_z).bits);
  EXPECT_EQ(trace.in_world, Facing::back);
  EXPECT_EQ(trace.in_ndc, Facing::back);
  EXPECT_EQ(trace.in_window, Facing::back);
  EXPECT_FALSE(trace.culled);

  // Turned, of the second object, and culled; beside the pixel; in an image that it leaves.
  const PrimitiveTrace turned = trace_triangle(scene, camera_of_wires(), options, 4, Pixel{2, 2});
  EXPECT_EQ(turned.in_window, Facing::front);
  EXPECT_EQ(turned.in_world, Facing::front);
  EXPECT_EQ(turned.fragments, fragments);
  ASSERT_TRUE(turned.sample);
  EXPECT_FALSE(turned.sample->covered);
  options.culling = Culling::back;
  const PrimitiveTrace culled = trace_triangle(scene, camera_of_wires(), options, 0, pixel);
  EXPECT_TRUE(culled.culled);
  EXPECT_EQ(culled.fragments, 0u);
  EXPECT_FALSE(culled.sample);
  options.culling = Culling::none;
  EXPECT_FALSE(trace_triangle(scene, camera_of_wires(), options, 0, {}).sample);
  for (const std::uint32_t size : {10u, 14u, 20u}) {
    Camera small = camera_of_wires();
    small.width = small.height = size;
    std::uint64_t inside = 0;
    for (std::int64_t y = 0; y < size; ++y) {
      for (std::int64_t x = 0; x < size; ++x) inside += is_covered(corners, sample_of({x, y}));
    }
    // Clipped at the sides: the new corners are snapped, which a centre on the way would notice.
    EXPECT_EQ(trace_triangle(scene, small, options, 0, {}).fragments, inside) << size;
  }
}

/// Mappings that are no projections are computed from the depth along the view, in the precision
/// that is asked for.
TEST(Trace, StoresWhatTheMappingMakesOfTheDepth) {
  const Scene scene =
      checks::scene_of({{-0.5, -0.5, 2.1}, {1.5, -1, 4.3}, {-0.3, 0.75, 3.7}}, {{0, 1, 2}});
  const auto mapped = [](Mapping mapping, auto D, auto n, auto f) {
    const decltype(D) one = 1;
    switch (mapping) {
      case Mapping::linear:
        return (D - n) / (f - n);
      case Mapping::w:
        return D / f;
      case Mapping::log:
        return std::log(one + D) / std::log(one + f);
      default:
        return std::log(D / n) / std::log(f / n);
    }
  };
  int different = 0;
  for (const Mapping mapping : {Mapping::linear, Mapping::w, Mapping::log, Mapping::log_ulrich}) {
    for (const Precision precision : {Precision::binary32, Precision::binary64}) {
      for (std::int64_t x = 10; x < 20; ++x) {
        PipelineOptions options;
        options.precision = precision;
        options.depth_format.mapping = mapping;
        options.depth_format.storage = Storage::float64;
        Camera c = camera_of_wires();
        c.near = 1.1;
        c.far = 99.7;
        const auto trace = trace_triangle(scene, c, options, 0, Pixel{x, 12});
        ASSERT_TRUE(trace.sample);
        const double D = trace.sample->depth;
        const double fine = mapped(mapping, D, 1.1, 99.7);
        const auto coarse =
            static_cast<double>(mapped(mapping, static_cast<float>(D), 1.1F, 99.7F));
        EXPECT_EQ(trace.sample->stored.bits,
                  store(Storage::float64, precision == Precision::binary64 ? fine : coarse).bits);
        different += fine != coarse;
      }
    }
  }
  EXPECT_GT(different, 60);
}

}  // namespace
}  // namespace fathom::pipeline
