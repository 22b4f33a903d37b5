// docs/sources.md, depth, output and antialiasing: errors 13 to 21.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "fathom/depth_format/encode.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/pipeline/trace.h"
#include "tests/inputs/scene_building.h"
#include "tests/pipeline/errata_cases.h"

namespace fathom::pipeline {
namespace {

using fathom::checks::scene_of;

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

}  // namespace
}  // namespace fathom::pipeline
