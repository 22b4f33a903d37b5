// The pipeline from end to end, against the exact engine and against its own promises.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/pipeline/fragments/texture.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/render.h"
#include "fathom/triangle/projected_triangle.h"
#include "tests/effort.h"
#include "tests/inputs/scene_building.h"
#include "tests/places.h"

namespace fathom::pipeline {
namespace {

using namespace triangle;

using fathom::checks::scene_of;

Camera camera_of(std::uint32_t width, std::uint32_t height, double near = 0.5, double far = 100) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection.fx = camera.projection.fy = width;
  camera.projection.cx = width / 2.0;
  camera.projection.cy = height / 2.0;
  camera.near = near;
  camera.far = far;
  return camera;
}

Scene random_scene(std::mt19937_64& random, int count, double least_z) {
  std::uniform_real_distribution<double> side(-4, 4), z(least_z, 12);
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (int i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (int k = 0; k < 3; ++k) vertices.push_back({side(random), side(random), z(random)});
    triangles.push_back({first, first + 1, first + 2});
  }
  return scene_of(std::move(vertices), std::move(triangles));
}

PipelineOptions precise(int bits) {
  PipelineOptions options;
  options.precision = Precision::binary64;
  options.depth_format.storage = Storage::float64;
  options.subpixel_bits = bits;
  options.shading = Shading::none;
  return options;
}

/// Whether the line l·(u, v, 1) = 0 passes the sample within a distance; computed in binary64,
/// which is far finer than the distances asked about.
bool passes_within(const ExactVector3& l, double u, double v, double distance) {
  const double a = round_to_binary64(l[0]), b = round_to_binary64(l[1]);
  const double value = round_to_binary64(l[0] * u + l[1] * v + l[2]);
  return std::abs(value) <= distance * std::hypot(a, b);
}

/// Whether moving corners by `distance` pixels can change which triangles cover the sample: one of
/// their edges, or the line at which near or far cuts one, passes within it.
bool is_explained(const Scene& scene, const Camera& camera, double u, double v, double distance) {
  TierCounts counts;
  for (std::uint32_t i = 0; i < scene.meshes[0].triangles.size(); ++i) {
    const auto t = project(world_corners(scene.objects[0], scene.meshes[0], i), i, camera, counts);
    if (t.orientation == Sign::zero) continue;
    for (const LinearForm& e : t.edges)
      if (passes_within(e.coefficients(), u, v, distance)) return true;
    for (const double limit : {camera.near, camera.far}) {
      ExactVector3 l;
      for (std::size_t k = 0; k < 3; ++k)
        l[k] = t.depth_numerator.coefficients()[k] - Dyadic(limit) * t.weight.coefficients()[k];
      if (passes_within(l, u, v, distance)) return true;
    }
  }
  return false;
}

struct Differences {
  int coverage = 0, unexplained = 0;
};

Differences compare_coverage(const Scene& scene, const Camera& camera, int bits) {
  RenderOptions exact_options;
  exact_options.engine = Engine::reference;
  exact_options.channels = {Channel::id};
  const DepthMap exact = render(scene, camera, exact_options).map;
  const auto& id = *exact.values<std::uint32_t>("id");
  const PipelineFrame frame = render_frame(scene, camera, precise(bits), false);
  // Snapping moves a corner by half a step along each axis; transform, division and viewport in
  // binary64 by less than 2^-30 of a pixel for coordinates below 2^20 (clipped corners are inside
  // the viewport, and their relative error is a few dozen roundings).
  const double distance = std::sqrt(2.0) * std::ldexp(0.5, -bits) + 0x1p-30;
  Differences differences;
  for (std::size_t i = 0; i < id.size(); ++i) {
    if ((id[i] == no_surface) == (frame.id[i] == no_surface)) continue;
    ++differences.coverage;
    const double u = static_cast<double>(i % camera.width) + 0.5;
    const double v = static_cast<double>(i / camera.width) + 0.5;
    differences.unexplained += !is_explained(scene, camera, u, v, distance);
  }
  return differences;
}

TEST(Engine, CoverageIsTheExactOneButForSnapping) {
  std::mt19937_64 random(1);
  Differences coarse, fine;
  for (int i = 0; i < 60 / checks::effort + 2; ++i) {
    // Every third scene reaches behind the camera.
    const Scene scene = random_scene(random, 6, i % 3 == 0 ? -3 : 1);
    const Camera camera = camera_of(64, 48);
    for (const int bits : {1, 4, 8, 16}) {
      const Differences d = compare_coverage(scene, camera, bits);
      (bits < 8 ? coarse : fine).coverage += d.coverage;
      EXPECT_EQ(d.unexplained, 0) << bits << " bits, scene " << i;
    }
  }
  EXPECT_GT(coarse.coverage, 10 / checks::effort);  // snapping is there to be seen
  EXPECT_LT(fine.coverage, coarse.coverage + 1);
}

TEST(Engine, VisibleTriangleIsTheExactOneAtSixteenBits) {
  std::mt19937_64 random(2);
  int different = 0, pixels = 0;
  for (int i = 0; i < 20 / checks::effort + 1; ++i) {
    const Scene scene = random_scene(random, 12, 1);
    const Camera camera = camera_of(64, 48);
    RenderOptions options;
    options.channels = {Channel::id};
    const DepthMap exact = render(scene, camera, options).map;
    const PipelineFrame frame = render_frame(scene, camera, precise(16), false);
    for (std::size_t k = 0; k < frame.id.size(); ++k, ++pixels)
      different += frame.id[k] != (*exact.values<std::uint32_t>("id"))[k];
  }
  // A corner moved by 2^-17 of a pixel changes a sample on its way with a probability of about the
  // length of all outlines times that: less than one of these pixels.
  EXPECT_LE(different, 1 + pixels / 20000);
}

TEST(Engine, BlocksAndEarlyDepthChangeNothing) {
  std::mt19937_64 random(3);
  const Scene scene = random_scene(random, 30, 1);
  const Camera camera = camera_of(70, 50);
  for (const AntialiasMethod method : {AntialiasMethod::none, AntialiasMethod::msaa}) {
    PipelineOptions options;
    options.antialias = {method, method == AntialiasMethod::msaa ? 8 : 1};
    const PipelineFrame with = render_frame(scene, camera, options, true);
    options.blocks = options.early_depth = false;
    const PipelineFrame without = render_frame(scene, camera, options, true);
    EXPECT_EQ(with.picture.pixels, without.picture.pixels);
    EXPECT_EQ(with.id, without.id);
    EXPECT_GT(with.statistics.blocks_skipped, 0u);
    EXPECT_LE(with.statistics.shaded, without.statistics.shaded);
  }
}

TEST(Engine, ScanLinesCoverWhatEdgeFunctionsDo) {
  std::mt19937_64 random(4);
  const Scene scene = random_scene(random, 20, 1);
  PipelineOptions options = precise(4);
  const PipelineFrame edges = render_frame(scene, camera_of(64, 48), options, true);
  options.scan = ScanConversion::scan_line;
  const PipelineFrame lines = render_frame(scene, camera_of(64, 48), options, true);
  EXPECT_EQ(edges.id, lines.id);
}

/// A quadrangle of two triangles that fills the middle of the picture, at depth 2.
Scene quadrangle() {
  return scene_of({{-0.61, -0.43, 2}, {0.57, -0.4, 2}, {0.59, 0.45, 2}, {-0.6, 0.41, 2}},
                  {{0, 1, 2}, {0, 2, 3}});
}

TEST(Engine, MultisamplingLeavesNoSeamOnASharedEdge) {
  const Camera camera = camera_of(64, 48);
  for (const int samples : {2, 4, 8, 16}) {
    PipelineOptions options;
    options.shading = Shading::none;
    options.antialias = {AntialiasMethod::msaa, samples};
    const PipelineFrame frame = render_frame(quadrangle(), camera, options, true);
    // Pixels well inside: x from 15 to 49, y from 13 to 35. The weights of the white corners add up
    // to 1 but for a few roundings of 2^-24; a seam would be of 1/16 at least.
    int partial = 0;
    for (std::uint32_t y = 14; y < 34; ++y)
      for (std::uint32_t x = 16; x < 49; ++x) ASSERT_NEAR(frame.picture.at(x, y)[0], 1, 1e-6);
    for (const Colour& c : frame.picture.pixels) partial += c[0] > 0.01 && c[0] < 0.99;
    EXPECT_GT(partial, 50);  // the outline is smoothed
  }
}

TEST(Engine, AreaSamplingGivesTheExactArea) {
  // A rectangle from 10.25 to 30.5 by 8.75 to 20: its pixels' weights are products of lengths.
  Camera camera = camera_of(40, 30);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.fx = camera.projection.fy = 1;
  camera.projection.cx = camera.projection.cy = 0;
  const Scene scene = scene_of({{10.25, 8.75, 2}, {30.5, 8.75, 2}, {30.5, 20, 2}, {10.25, 20, 2}},
                               {{0, 1, 2}, {0, 2, 3}});
  PipelineOptions options;
  options.shading = Shading::none;
  options.antialias = {AntialiasMethod::area, 1};
  const PipelineFrame frame = render_frame(scene, camera, options, true);
  EXPECT_EQ(frame.picture.at(10, 8)[0], 0.75 * 0.25);
  EXPECT_EQ(frame.picture.at(30, 12)[0], 0.5);
  EXPECT_EQ(frame.picture.at(10, 19)[0], 0.75);
  EXPECT_EQ(frame.picture.at(20, 12)[0], 1.0);
  EXPECT_EQ(frame.picture.at(20, 20)[0], 0.0);
}

TEST(Engine, SupersamplingComesNearTheArea) {
  const Camera camera = camera_of(48, 36);
  PipelineOptions options;
  options.shading = Shading::none;
  const auto picture = [&](AntialiasMethod method, int count) {
    options.antialias = {method, count};
    return render_frame(quadrangle(), camera, options, true).picture;
  };
  const ColourImage truth = picture(AntialiasMethod::area, 1);
  const auto error = [&](const ColourImage& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      sum += std::abs(image.pixels[i][0] - truth.pixels[i][0]);
    return sum;
  };
  const double none = error(picture(AntialiasMethod::none, 1));
  EXPECT_LT(error(picture(AntialiasMethod::msaa, 4)), none / 2);
  EXPECT_LT(error(picture(AntialiasMethod::msaa, 16)), none / 4);
  EXPECT_LT(error(picture(AntialiasMethod::ssaa, 8)), none / 8);
  EXPECT_LT(error(picture(AntialiasMethod::jitter, 16)), none / 3);
  EXPECT_LT(error(picture(AntialiasMethod::taa, 32)), none / 4);
  EXPECT_LT(error(picture(AntialiasMethod::fxaa, 1)), none);
}

TEST(Engine, BlendingDependsOnTheOrderAndSelectingDoesNot) {
  const std::vector<MeshPoint> corners{{-1, -1, 2}, {1, -1, 2}, {0, 1, 2},
                                       {-1, -1, 3}, {1, -1, 3}, {0, 1, 3}};
  Scene there = scene_of(corners, {{0, 1, 2}, {3, 4, 5}}),
        back = scene_of(corners, {{3, 4, 5}, {0, 1, 2}});
  for (Scene* scene : {&there, &back}) {
    scene->meshes[0].colours.assign(6, {1, 0, 0, 1});
    for (std::size_t k = 3; k < 6; ++k) scene->meshes[0].colours[k] = {0, 0, 1, 1};
  }
  PipelineOptions options;
  options.shading = Shading::none;
  const Camera camera = camera_of(32, 32);
  EXPECT_EQ(render_frame(there, camera, options, true).picture.pixels,
            render_frame(back, camera, options, true).picture.pixels);
  options.blend_alpha = 0.5;
  const Colour first = render_frame(there, camera, options, true).picture.at(16, 16);
  const Colour second = render_frame(back, camera, options, true).picture.at(16, 16);
  EXPECT_EQ(first, (Colour{0.25, 0, 0.5}));
  EXPECT_EQ(second, (Colour{0.5, 0, 0.25}));
}

TEST(Engine, CullingByEitherSideAndFrontFace) {
  const Camera camera = camera_of(32, 32);
  const Scene ccw = scene_of({{-1, 1, 2}, {1, 1, 2}, {0, -1, 2}}, {{0, 1, 2}});  // y down
  const auto drawn = [&](Culling culling, FrontFace front) {
    PipelineOptions options;
    options.culling = culling;
    options.front_face = front;
    return render_frame(ccw, camera, options, false).statistics.drawn;
  };
  EXPECT_EQ(drawn(Culling::none, FrontFace::clockwise), 1u);
  EXPECT_EQ(drawn(Culling::back, FrontFace::counter_clockwise), 1u);
  EXPECT_EQ(drawn(Culling::front, FrontFace::counter_clockwise), 0u);
  EXPECT_EQ(drawn(Culling::back, FrontFace::clockwise), 0u);
  EXPECT_EQ(drawn(Culling::front, FrontFace::clockwise), 1u);
}

TEST(Engine, ViewportScissorAndOrigin) {
  PipelineOptions options;
  options.shading = Shading::none;
  options.viewport = WindowRectangle{0, 0, 16, 16};  // the lower left quarter
  const Scene scene = scene_of({{-9, -9, 2}, {9, -9, 2}, {0, 18, 2}}, {{0, 1, 2}});
  const PipelineFrame frame = render_frame(scene, camera_of(32, 32), options, true);
  EXPECT_EQ(frame.picture.at(3, 28)[0], 1.0);
  EXPECT_EQ(frame.picture.at(3, 3)[0], 0.0);
  EXPECT_EQ(frame.picture.at(28, 28)[0], 0.0);
  options.scissor = WindowRectangle{4, 0, 100, 3};
  const PipelineFrame cut = render_frame(scene, camera_of(32, 32), options, true);
  EXPECT_EQ(cut.picture.at(5, 30)[0], 1.0);
  EXPECT_EQ(cut.picture.at(3, 30)[0], 0.0);
  EXPECT_EQ(cut.picture.at(5, 28)[0], 0.0);
}

TEST(Engine, CornersThatAreNoNumbersAreLeftOutAndCounted) {
  const Scene scene =
      scene_of({{1e39, 0, 2}, {1, 0, 2}, {0, 1, 2}, {-1, 0, 2}}, {{0, 1, 2}, {1, 2, 3}});
  const PipelineFrame frame = render_frame(scene, camera_of(32, 32), {}, true);
  EXPECT_EQ(frame.statistics.not_finite, 1u);
  EXPECT_EQ(frame.statistics.drawn, 1u);
  // Each coordinate by itself, beyond binary32.
  for (const MeshPoint& beyond : {MeshPoint{1e39, 0, 2}, {0, 1e39, 2}, {0, 0, 1e39}}) {
    const Scene alone = scene_of({beyond, {1, 0, 2}, {0, 1, 2}}, {{0, 1, 2}});
    EXPECT_EQ(render_frame(alone, camera_of(32, 32), {}, true).statistics.not_finite, 1u);
  }
}

TEST(Engine, CornersAtTheEyeAndBehindItAreClipped) {
  // One corner in the plane of the eye, w = 0, one behind it.
  const Scene scene =
      scene_of({{0, 0, 0}, {1, 0, 4}, {0, 1, 4}, {0, 0, -3}}, {{0, 1, 2}, {3, 1, 2}});
  const PipelineFrame frame = render_frame(scene, camera_of(32, 32), {}, true);
  EXPECT_EQ(frame.statistics.clipped, 2u);
  EXPECT_EQ(frame.statistics.not_finite, 0u);
}

TEST(Engine, EveryDepthFormatFindsTheNearerOfTwo) {
  const Scene scene =
      scene_of({{-1, -1, 9}, {1, -1, 9}, {0, 1, 9}, {-1, -1, 4}, {1, -1, 4}, {0, 1, 4}},
               {{0, 1, 2}, {3, 4, 5}});
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : all_storages) {
      PipelineOptions options;
      options.depth_format.mapping = mapping;
      options.depth_format.storage = storage;
      const PipelineFrame frame = render_frame(scene, camera_of(32, 32), options, false);
      EXPECT_EQ(frame.id[16 * 32 + 16], 1u) << name_of(mapping) << " " << name_of(storage);
      EXPECT_NEAR(static_cast<double>(frame.depth[16 * 32 + 16]), 4, 1e-5);  // a few roundings
    }
  }
}

TEST(DepthTest, StoresTheNearestCode) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 20000 / checks::effort; ++i) {
    double z =
        i % 4 == 0 ? std::ldexp(unit(random), -static_cast<int>(random() % 70)) : unit(random);
    if (i % 5 == 0) z = (static_cast<double>(random() % 65535) + 0.5) / 65535;
    if (i == 0) z = 1;
    for (const Storage storage : all_storages)
      ASSERT_EQ(store(storage, z), round_to_storage(storage, Real(Ratio(Dyadic(z)))))
          << name_of(storage) << " " << z;
  }
}

TEST(Options, WhatDoesNotExistIsRefused) {
  const auto refused = [](const auto& change) {
    PipelineOptions options;
    change(options);
    EXPECT_THROW(require_meaningful(options), UsageError);
  };
  refused([](auto& o) { o.antialias = {AntialiasMethod::msaa, 3}; });
  refused([](auto& o) { o.antialias = {AntialiasMethod::ssaa, 0}; });
  refused([](auto& o) { o.antialias = {AntialiasMethod::jitter, 257}; });
  refused([](auto& o) { o.antialias = {AntialiasMethod::jitter, 8}; });
  refused([](auto& o) { o.viewport = WindowRectangle{0, 0, 0, 5}; });
  refused([](auto& o) { o.scissor = WindowRectangle{0, 0, 5, -1}; });
  refused([](auto& o) { o.subpixel_bits = 17; });
  refused([](auto& o) { o.depth_range = {0, 1.5}; });
  refused([](auto& o) { o.depth_range = {std::nan(""), 1}; });
}

TEST(Texture, MissingOrBrokenOnesAreRefused) {
  EXPECT_THROW(read_rgb_png("/nonexistent/texture.png"), InputError);
  EXPECT_THROW(read_rgb_png(test::source_dir() / "README.md"), InputError);
  PipelineOptions options;
  options.texture = "checker";
  EXPECT_THROW(render_frame(quadrangle(), camera_of(8, 8), options, true), InputError);
}

TEST(Texture, FiltersOfTheChecker) {
  const Texture checker = Texture::checker();
  EXPECT_EQ(checker.level_count(), 9u);
  const TextureFootprint fine{{1.0 / 16, 1.0 / 16}, {1e-4, 0}, {0, 1e-4}};
  const TextureFootprint coarse{{1.0 / 16, 1.0 / 16}, {2, 0}, {0, 2}};
  const TextureFootprint oblique{{1.0 / 16, 1.0 / 16}, {1e-3, 0}, {0, 2}};
  const Colour square = checker.sample(fine, TextureFilter::nearest);
  EXPECT_EQ(square, checker.sample(fine, TextureFilter::trilinear));
  EXPECT_EQ(square, checker.sample(fine, TextureFilter::anisotropic));
  EXPECT_EQ(checker.sample(coarse, TextureFilter::trilinear), (Colour{0.5, 0.5, 0.5}));
  EXPECT_EQ(checker.sample(oblique, TextureFilter::trilinear), (Colour{0.5, 0.5, 0.5}));
}

/// Three long triangles, each over one and under the other.
Scene cycle() {
  std::vector<MeshPoint> v;
  std::vector<CornerIndices> t;
  for (int k = 0; k < 3; ++k) {
    const double a = k * 2 * std::acos(-1.0) / 3, c = std::cos(a), s = std::sin(a);
    const auto at = [&](double x, double y, double z) {
      v.push_back({c * x - s * y, s * x + c * y, z});
    };
    const auto first = static_cast<std::uint32_t>(v.size());
    at(-1.2, -0.6, 4.5);
    at(1.2, -0.45, 3.5);
    at(1.2, -0.15, 3.5);
    t.push_back({first, first + 1, first + 2});
  }
  return scene_of(std::move(v), std::move(t));
}

Scene penetration() {
  return scene_of({{-1, -1, 3}, {1, -0.9, 5}, {0.1, 1, 4}, {-1.1, 0.8, 5}, {1, 0.7, 3}, {0, -1, 4}},
                  {{0, 1, 2}, {3, 4, 5}});
}

TEST(Painter, ResolvesCyclesAndPenetration) {
  for (const Scene& scene : {cycle(), penetration()}) {
    const Camera camera = camera_of(96, 96);
    PipelineOptions options = precise(16);
    const PipelineFrame buffer = render_frame(scene, camera, options, false);
    options.hidden_surface = HiddenSurface::painter;
    const PipelineFrame painter = render_frame(scene, camera, options, false);
    EXPECT_GT(painter.painter.splits, 0u);
    int different = 0;
    for (std::size_t i = 0; i < buffer.id.size(); ++i) different += buffer.id[i] != painter.id[i];
    // The pieces' corners are snapped too: a pixel or two along the cuts.
    EXPECT_LE(different, 4);
  }
}

TEST(Painter, ThousandTrianglesComeToAnEndAndToTheSamePicture) {
  // Many small ones in many overlaps: rounded cuts must not be cut again and again.
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> place(-2, 2), depth(4, 8), size(-0.4, 0.4);
  std::vector<MeshPoint> v;
  std::vector<CornerIndices> t;
  for (std::uint32_t i = 0; i < 1000 / checks::effort; ++i) {
    const double x = place(random), y = place(random), z = depth(random);
    for (int k = 0; k < 3; ++k) v.push_back({x + size(random), y + size(random), z + size(random)});
    t.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const Scene scene = scene_of(std::move(v), std::move(t));
  const Camera camera = camera_of(160, 120);
  PipelineOptions options = precise(16);
  const PipelineFrame buffer = render_frame(scene, camera, options, false);
  options.hidden_surface = HiddenSurface::painter;
  const PipelineFrame painter = render_frame(scene, camera, options, false);
  int different = 0;
  for (std::size_t i = 0; i < buffer.id.size(); ++i) different += buffer.id[i] != painter.id[i];
  EXPECT_LE(different, 20);  // of 19200: along cuts, whose corners are rounded and snapped
  EXPECT_LT(painter.painter.splits, 20000u);
}

TEST(Painter, EachTestOfNewellSettlesItsCase) {
  const Camera camera = camera_of(64, 64);
  PipelineOptions options = precise(8);
  options.hidden_surface = HiddenSurface::painter;
  const auto ran = [&](const Scene& scene) {
    return render_frame(scene, camera, options, false).painter;
  };
  const auto pair = [](MeshPoint a, MeshPoint b, MeshPoint c, MeshPoint d, MeshPoint e,
                       MeshPoint f) {
    return scene_of({a, b, c, d, e, f}, {{0, 1, 2}, {3, 4, 5}});
  };
  EXPECT_EQ(
      ran(pair({-1, -1, 3}, {0, -1, 3}, {0, 0, 3}, {-1, -1, 6}, {0, -1, 6}, {0, 0, 6})).z_disjoint,
      1u);
  EXPECT_EQ(
      ran(pair({-1, -1, 3}, {-0.1, -1, 5}, {-0.5, 0, 4}, {1, -1, 4}, {0.1, -1, 3}, {0.5, 0, 5}))
          .settled[0],
      1u);
  EXPECT_EQ(ran(pair({-1, -1, 3}, {1, -1, 5}, {0, -0.1, 4}, {-1, 1, 4}, {1, 1, 3}, {0, 0.1, 5}))
                .settled[1],
            1u);
  EXPECT_EQ(
      ran(pair({-1, -1, 3}, {1, -1, 5}, {1, 1, 5}, {-1, -0.8, 4}, {1, -0.8, 6}, {1, 1, 6}))
              .settled[2] +
          ran(pair({-1, -1, 3}, {1, -1, 5}, {1, 1, 5}, {-1, -0.8, 4}, {1, -0.8, 6}, {1, 1, 6}))
              .settled[3],
      1u);
  const PainterStatistics moved = ran(pair({-1.5, -1.5, 3}, {1.5, -1.4, 3}, {0, 1.5, 6},
                                           {-0.2, 0.3, 2.9}, {0.2, 0.3, 2.9}, {0, -0.2, 6.5}));
  EXPECT_GT(moved.comparisons, 0u);
}

}  // namespace
}  // namespace fathom::pipeline
