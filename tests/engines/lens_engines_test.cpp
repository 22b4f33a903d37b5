// The fast engine against the reference engine under lenses, bit for bit.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "fathom/failures/errors.h"
#include "fathom/render.h"
#include "tests/adversaries.h"
#include "tests/effort.h"
#include "tests/engines/expect_same_map.h"
#include "tests/inputs/lens_scenes.h"
#include "tests/inputs/soup.h"
#include "tests/inputs/spheres.h"
#include "tests/inputs/tables_of_directions.h"

namespace fathom {
namespace {

using checks::expect_same;
using checks::expect_same_map;
using checks::Kind;
using checks::LensCase;
using checks::LensCaseMaker;
using checks::NamedLens;

std::vector<Channel> lens_channels(const std::vector<Channel>& channels) {
  std::vector<Channel> with_valid = channels;
  std::erase(with_valid, Channel::A);
  with_valid.push_back(Channel::valid);
  return with_valid;
}

class LensAdversaries : public ::testing::TestWithParam<std::tuple<LensModel, Kind>> {};

TEST_P(LensAdversaries, AreTheSame) {
  const auto [model, kind] = GetParam();
  RenderStatistics sum;
  checks::for_each_adversary(25, [&, model = model, kind = kind](std::uint64_t seed) {
    LensCaseMaker maker(10000 * seed + static_cast<std::uint64_t>(100 * static_cast<int>(model)) +
                            static_cast<std::uint64_t>(kind),
                        kind);
    const LensCase c = maker.make(model);
    RenderOptions options;
    options.threads = 1;
    options.channels =
        lens_channels(seed % 10 == 0 ? checks::every_channel : checks::quick_channels);
    options.cull = seed % 7 == 0 ? Cull::back : seed % 7 == 1 ? Cull::front : Cull::none;
    add(sum, expect_same(c.view.scene, c.view.camera, options));
  });
  if (checks::effort > 1 || (kind != Kind::few_bits && kind != Kind::neighbours)) return;
  // Every tier was reached.
  const std::uint64_t often = is_plane(model) ? 5 : 0;
  EXPECT_GT(sum.exact_setups, often);
  // Random edges pass through no sample of a fisheye, and few of FOV and of a model with a root.
  const RayFormula formula = entry_of(model).formula;
  if (formula != RayFormula::angle && formula != RayFormula::angle_of_sample &&
      formula != RayFormula::field_of_view && formula != RayFormula::root) {
    EXPECT_GT(sum.edges.exact, often);
  }
  EXPECT_GT(sum.rounding.interval, 5U);
}

std::string name_of_case(const ::testing::TestParamInfo<std::tuple<LensModel, Kind>>& info) {
  const auto [model, kind] = info.param;
  constexpr std::array kinds{"few_bits", "neighbours", "huge", "tiny"};
  return std::string(name_of(model)) + '_' + kinds[static_cast<std::size_t>(kind)];
}

INSTANTIATE_TEST_SUITE_P(Fast, LensAdversaries,
                         ::testing::Combine(::testing::ValuesIn(checks::bending_models()),
                                            ::testing::Values(Kind::few_bits, Kind::neighbours,
                                                              Kind::huge, Kind::tiny)),
                         name_of_case);

/// Most are used far beyond where they fold.
std::vector<NamedLens> lenses() {
  const auto opencv = [](std::array<double, 14> distortion) {
    return Lens{LensModel::opencv_14, distortion};
  };
  Lens narrow{LensModel::simple_radial, {-0.1}};
  narrow.max_radius = 0.8;
  Lens ends{LensModel::simple_pinhole};
  ends.max_radius = 0.75;
  Lens angle{LensModel::fisheye_stereographic};
  angle.max_radius = 1;
  return {
      {"barrel", {LensModel::simple_radial, {-0.25}}},
      {"pincushion", {LensModel::simple_radial, {0.2}}},
      {"folds", {LensModel::radial, {-0.4, 0.05}}},
      {"tangential", {LensModel::opencv, {-0.15, 0.02, 0.01, -0.02}}},
      {"rational", opencv({-0.1, 0.02, 0.001, 0.002, 0.003, 0.05, 0.01, 0.001})},
      {"thin prism",
       opencv({-0.1, 0.02, 0.001, 0.002, 0.003, 0, 0, 0, 0.01, -0.002, 0.004, 0.001})},
      {"tilted", opencv({-0.1, 0.02, 0.001, 0.002, 0, 0, 0, 0, 0, 0, 0, 0, 0.05, -0.03})},
      {"narrow", narrow},
      {"pinhole that ends", ends},
      {"field of view", {LensModel::fov, {1.25}}},
      {"field of view that ends", {LensModel::fov, {-0.5}, 0.75}},
      {"nearly no field of view", {LensModel::fov, {1e-300}, 1}},
      {"stereographic", {LensModel::fisheye_stereographic}},
      {"stereographic that ends", angle},
      {"division", {LensModel::simple_division, {-0.25}}},
      {"division to all sides", {LensModel::division, {-1.5}}},
      {"division that ends", {LensModel::division, {0.5}}},
      {"fisheye", {LensModel::simple_fisheye}},
      {"fisheye that folds", {LensModel::opencv_fisheye, {-0.1, 0.01, -0.01, 0.001}}},
      {"fisheye that ends", {LensModel::radial_fisheye, {0.05, -0.01}, 1.25}},
      {"thin prisms",
       {LensModel::thin_prism_fisheye, {0.02, -0.01, 0.001, -0.002, 0.003, 0.001, 0.01, -0.005}}},
      {"two stages",
       {LensModel::rad_tan_thin_prism_fisheye,
        {0.02, -0.01, 0.004, -0.001, 0.0002, -0.0001, 0.003, -0.002, 0.01, 0.001, -0.005, 0.002}}},
      {"two stages that fold",
       {LensModel::rad_tan_thin_prism_fisheye, {-0.1, 0.01, 0, 0, 0, 0, 0.02, 0, 0.05, -0.01}}},
      {"orthographic", {LensModel::fisheye_orthographic}},
      {"orthographic that ends", {LensModel::fisheye_orthographic, {}, 0.75}},
      {"equisolid", {LensModel::fisheye_equisolid}},
      {"unified", {LensModel::ucm, {0.625}}},
      {"unified to all sides", {LensModel::eucm, {0.45, 12}}},
      {"unified that ends", {LensModel::eucm, {0.7, 1.25}, 1.5}},
      {"double sphere", {LensModel::double_sphere, {-0.25, 0.6}}},
      {"omnidirectional", {LensModel::omni, {0.875}}},
      {"mirror", {LensModel::omni, {1.5}}},
      {"omnidirectional and bent", {LensModel::omni, {0.875, -0.05, 0.01, 0.002, -0.003}}},
      {"bent mirror that ends", {LensModel::omni, {1.5, 0.05, 0, 0.01, 0.02}, 1.25}},
      {"angle by a polynomial", {LensModel::ftheta, {0, 1, 0.125, -0.25, 0.0625, -0.01}}},
      {"angle on both sides that ends", {LensModel::ftheta, {-0.25, 1.25, 0.1}, 1.25}},
      {"equirectangular", {LensModel::equirectangular}},
      {"equirectangular that ends", {LensModel::equirectangular, {}, 1.25}},
      {"cylindrical", {LensModel::cylindrical}},
      {"cylindrical that ends", {LensModel::cylindrical, {}, 2}}};
}

Camera camera_of_lens(const Lens& lens) {
  Camera camera = checks::camera_of(160, 140, 64);
  camera.projection.lens = lens;
  return camera;
}

TEST(FastLenses, TrianglesAcrossTilesOfAnyNumberOfThreads) {
  std::mt19937_64 random(4712);
  int i = 0;
  for (const NamedLens& named : lenses()) {
    SCOPED_TRACE(named.name);
    const Scene scene =
        i % 2 == 0 ? checks::soup(random, 30, i % 4 == 0) : checks::slivers(random, 30);
    Camera camera = camera_of_lens(named.lens);
    camera.width = 100;
    camera.height = 90;
    if (i % 3 == 0) camera.far = 5;
    if (i % 3 == 1) camera.near = 2;
    if (has_two_focal_lengths(entry_of(named.lens.model))) {
      if (i % 2 == 0) camera.projection.fx = -camera.projection.fx;
      if (i % 4 > 1) camera.projection.skew = 7;
    }
    RenderOptions options;
    options.channels = lens_channels(checks::quick_channels);
    const DepthMap truth = render_reference(scene, camera, options).map;
    options.threads = 1 + i % 3;
    expect_same_map(render_fast(scene, camera, options).map, truth);
    options.fast.early_rejection = options.fast.hierarchy = false;
    options.fast.widening = 0x1p20;
    expect_same_map(render_fast(scene, camera, options).map, truth);
    ++i;
  }
}

TEST(FastLenses, EveryChannelOfSpheres) {
  const Scene scene = checks::two_spheres(12);
  for (const NamedLens& named : lenses()) {
    SCOPED_TRACE(named.name);
    Camera camera = camera_of_lens(named.lens);
    camera.width = 70;
    camera.height = 66;
    camera.projection.fx = camera.projection.fy = 40;
    camera.projection.cx = 35;
    camera.projection.cy = 33;
    camera.world_to_camera[2][3] = 3;
    RenderOptions options;
    options.channels = lens_channels(checks::every_channel);
    expect_same(scene, camera, options);
  }
}

// The eye lies inside of the scene, triangles pass it, and some corners are behind it.
TEST(FastLenses, TrianglesAroundTheEye) {
  const Scene scene = checks::two_spheres(8);
  Camera camera = camera_of_lens({LensModel::simple_radial, {-0.2}});
  camera.world_to_camera[2][3] = 0.125;
  RenderOptions options;
  options.channels = lens_channels(checks::quick_channels);
  expect_same(scene, camera, options);
}

TEST(FastLenses, MemoryOfOneFrameServesTheNext) {
  std::mt19937_64 random(4713);
  const Scene scene = checks::soup(random, 60, false);
  RenderMemory memory;
  const RenderContext context{.kept = &memory};
  RenderOptions options;
  options.channels = lens_channels(checks::quick_channels);
  DepthMap before;
  const std::vector<NamedLens> all = lenses();
  for (const std::size_t number : {0U, 3U, 7U, 12U}) {
    const NamedLens& named = all[number];
    SCOPED_TRACE(named.name);
    for (const double z : {0.0, 0.5}) {
      for (const std::uint32_t width : {80U, 70U}) {
        Camera camera = camera_of_lens(named.lens);
        camera.width = width;
        camera.height = 70;
        camera.world_to_camera[2][3] = z;
        const DepthMap truth = render_reference(scene, camera, options).map;
        before = render_fast(scene, camera, options, context, std::move(before)).map;
        expect_same_map(before, truth);
      }
    }
  }
}

// The image lies so far from the axis of the camera that its pixels are less than those of the
// window.
TEST(FastLenses, AnImageFarFromTheAxis) {
  Camera camera = camera_of_lens({LensModel::simple_radial, {1e-22}});
  camera.width = camera.height = 20;
  camera.projection.cx = -1e12;
  const double m = 1.53e10;
  const Scene scene = checks::scene_of(
      {{0, -1, 1}, {2 * m, -1, 1}, {m, 1, 1}, {m, -m, 2}, {m, m, 2}, {2 * m, 0, 2}},
      {{0, 1, 2}, {3, 4, 5}});
  RenderOptions options;
  options.channels = lens_channels(checks::quick_channels);
  const RenderStatistics statistics = expect_same(scene, camera, options);
  EXPECT_GT(statistics.pixels_with_surface, 0U);
}

/// A scene that covers the plane z = 1 around a point, and one triangle nearer.
Scene around(double x, double y, double size) {
  return checks::scene_of({{x - size, y - size, 1},
                           {x + 3 * size, y - size, 1},
                           {x - size, y + 3 * size, 1},
                           {x / 2 - size / 8, y / 2, 0.5},
                           {x / 2 + size / 4, y / 2, 0.5},
                           {x / 2, y / 2 + size / 4, 0.5}},
                          {{0, 1, 2}, {3, 4, 5}});
}

struct HardLens {
  const char* name;
  LensModel model;
  std::array<double, 14> distortion;
  double fx, fy, cx, cy, skew, max_radius;
  std::uint32_t width, height;
};

// Numbers with which residuals, squares, widths or places underflow or overflow, or with which
// places err by more along one axis than along the other.
TEST(FastLenses, HardNumbers) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const HardLens hard[] = {
      {"residuals underflow",
       LensModel::opencv,
       {0, 0, 0x1.4cp524},
       0x1p535,
       0x1p535,
       32,
       32,
       0,
       infinity,
       32,
       32},
      {"max_radius squared underflows",
       LensModel::pinhole,
       {},
       1e165,
       1e165,
       4,
       4,
       0,
       1e-170,
       16,
       16},
      {"one axis is longer",
       LensModel::pinhole,
       {},
       0x1p43,
       0x1p-10,
       -0x1p57,
       -0.5,
       0x1p47,
       8e4,
       200,
       1},
      {"width overflows", LensModel::pinhole, {}, 1e-306, 1, 20, 0.5, 0, 1.7e308, 40, 1},
      {"places overflow",
       LensModel::full_opencv,
       {0.1, 0, 0, 0, 0, 0.1},
       1e-320,
       1,
       20,
       0.5,
       0,
       infinity,
       40,
       1},
      {"focal length near overflow",
       LensModel::simple_radial,
       {1},
       1.5e308,
       1.5e308,
       0.5,
       0.5,
       0,
       infinity,
       1,
       1},
      {"z underflows", LensModel::pinhole, {}, 0x1p540, 0x1p540, -0.5, -0.5, 0, 1, 1, 1},
  };
  for (const HardLens& h : hard) {
    SCOPED_TRACE(h.name);
    Camera camera;
    camera.width = h.width;
    camera.height = h.height;
    Lens lens{h.model, h.distortion};
    lens.max_radius = h.max_radius;
    camera.projection = {.fx = h.fx, .fy = h.fy, .cx = h.cx, .cy = h.cy, .skew = h.skew};
    camera.projection.lens = lens;
    RenderOptions options;
    options.channels = lens_channels(checks::every_channel);
    std::erase(options.channels, Channel::Ns);
    for (const double size : {1.0, 4 / std::abs(h.fx), 100.0}) {
      const double x = (h.width / 2.0 - h.cx) / h.fx;
      if (!std::isfinite(size) || !std::isfinite(x * 4 + size * 8)) continue;
      expect_same(around(x, 0, size), camera, options);
    }
  }
}

class TableAdversaries : public ::testing::TestWithParam<Kind> {};

// Some directions are those of corners, and of middles between two.
TEST_P(TableAdversaries, AreTheSame) {
  const Kind kind = GetParam();
  RenderStatistics sum;
  checks::for_each_adversary(26, [&](std::uint64_t seed) {
    checks::CaseMaker cases(100 * seed + static_cast<std::uint64_t>(kind), kind);
    checks::Case c = cases.make();
    std::vector<double> numbers = checks::DirectionMaker(seed).numbers(30);
    if (seed % 2 == 0) {
      c.camera.world_to_camera = Camera().world_to_camera;
      checks::aim_at_corners(c.scene, numbers);
    }
    const Camera camera = checks::with_table(c.camera, std::move(numbers));
    RenderOptions options;
    options.threads = 1;
    options.channels =
        lens_channels(seed % 10 == 0 ? checks::every_channel : checks::quick_channels);
    options.cull = seed % 7 == 0 ? Cull::back : seed % 7 == 1 ? Cull::front : Cull::none;
    add(sum, expect_same(c.scene, camera, options));
  });
  if (checks::effort > 1 || (kind != Kind::few_bits && kind != Kind::neighbours)) return;
  EXPECT_GT(sum.edges.exact, 5U);
  EXPECT_GT(sum.rounding.interval, 5U);
}

INSTANTIATE_TEST_SUITE_P(Fast, TableAdversaries,
                         ::testing::Values(Kind::few_bits, Kind::neighbours, Kind::huge,
                                           Kind::tiny));

/// A panorama of all directions; that of a cylinder of a few degrees where `height` is 1.
Camera panorama(std::uint32_t width, std::uint32_t height) {
  std::vector<double> numbers;
  for (std::uint32_t row = 0; row < height; ++row) {
    const double up = height == 1 ? 0.125 : (0.5 - (row + 0.5) / height) * std::numbers::pi;
    for (std::uint32_t column = 0; column < width; ++column) {
      const double turn = ((column + 0.5) / width - 0.5) * 2 * std::numbers::pi;
      numbers.insert(numbers.end(),
                     {std::cos(up) * std::sin(turn), -std::sin(up), std::cos(up) * std::cos(turn)});
    }
  }
  Camera camera;
  camera.width = width;
  camera.height = height;
  return checks::with_table(camera, std::move(numbers));
}

// Tiles of one view and of several; depths of all signs; ranges of distances.
TEST(FastTables, PanoramasOfAnyNumberOfThreads) {
  std::mt19937_64 random(4716);
  int i = 0;
  for (const auto& [width, height] :
       {std::pair(300U, 150U), std::pair(70U, 40U), std::pair(500U, 1U)}) {
    for (int k = 0; k < 3; ++k, ++i) {
      SCOPED_TRACE(i);
      const Scene scene = k == 2 ? checks::two_spheres(8) : checks::soup(random, 60, k == 1);
      Camera camera = panorama(width, height);
      camera.world_to_camera[0][3] = k == 2 ? 0.125 : -1;
      camera.world_to_camera[2][3] = k == 2 ? 0.25 : -2;
      if (i % 3 != 0) camera.near = 1.5;
      if (i % 3 == 2) camera.far = 2.5;
      if (k == 1) camera.projection.lens->max_radius = 2;
      RenderOptions options;
      options.channels = lens_channels(i % 2 == 0 ? checks::every_channel : checks::quick_channels);
      const DepthMap truth = render_reference(scene, camera, options).map;
      options.threads = 1 + i % 3;
      expect_same_map(render_fast(scene, camera, options).map, truth);
      options.fast.early_rejection = options.fast.hierarchy = false;
      options.fast.widening = 0x1p20;
      expect_same_map(render_fast(scene, camera, options).map, truth);
    }
  }
}

// All in one place, on a line, with components that differ by hundreds of orders of magnitude,
// and subnormal ones.
TEST(FastTables, HardNumbers) {
  const std::vector<std::vector<double>> tables{
      {1, 1, 2, 1, 1, 2, 1, 1, 2, 1, 1, 2},
      {0, 0, 1, 0x1p-1074, 0, 1, 0, 0x1p-1074, 1, -0x1p-1074, 0x1p-1074, 1},
      {0x1p-1074, 0, 0x1p-1074, 0, 0, 0x1p-1074, 0x3p-1074, 0x1p-1073, 0x1p-1072, 0, 0, -0x1p-1074},
      {0x1p1023, 0x1p1023, 0x1p1023, 0x1p1023, -0x1p1023, 0x1.fp1023, 1, 0, 0x1p1023, 0, 1,
       0x1p1023},
      {1, 0, 0x1p-300, 1, 0x1p-600, 0, 1, 0x1p-30, 0x1p-30, 1, 0, -0x1p-1074},
      {1, 0x1p-52, 1, 1, 0, 1, 1, -0x1p-52, 1, 1, 0x1p-53, 1}};
  for (std::size_t i = 0; i < tables.size(); ++i) {
    SCOPED_TRACE(i);
    Camera camera;
    camera.width = camera.height = 2;
    camera = checks::with_table(camera, tables[i]);
    RenderOptions options;
    options.channels = lens_channels(checks::every_channel);
    expect_same(checks::box_scene(1, 1, 1), camera, options);
    expect_same(around(1, 0, 1), camera, options);
    expect_same(around(0, 0, 1), camera, options);
  }
}

// Of samples beyond the disc, and of all samples.
TEST(FastLenses, NoSampleHasARay) {
  Camera camera = camera_of_lens({LensModel::simple_radial, {-0.25}});
  camera.projection.cx = 1000;
  RenderOptions options;
  options.channels = lens_channels(checks::quick_channels);
  std::mt19937_64 random(4714);
  expect_same(checks::soup(random, 20, false), camera, options);
}

TEST(FastLenses, TheEnginesRefuseTheSame) {
  std::mt19937_64 random(4715);
  const Scene scene = checks::soup(random, 2, false);
  const Camera camera = camera_of_lens({LensModel::simple_radial, {-0.25}});
  RenderOptions options;
  options.channels = {Channel::A};
  for (const Engine engine : {Engine::fast, Engine::reference}) {
    options.engine = engine;
    EXPECT_THROW(render(scene, camera, options), UsageError);
  }
}

}  // namespace
}  // namespace fathom
