// The fast engine against the reference engine, bit for bit.
#include <gtest/gtest.h>

#include <set>

#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"
#include "fathom/render.h"
#include "fathom/threads/threads.h"
#include "tests/effort.h"
#include "tests/engines/expect_same_map.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/soup.h"
#include "tests/inputs/spheres.h"

namespace fathom {
namespace {

using checks::CaseMaker;
using checks::every_channel;
using checks::expect_same;
using checks::Kind;
using checks::quick_channels;
using checks::soup;
using checks::two_spheres;

class RandomScenes : public ::testing::TestWithParam<std::tuple<Kind, int>> {};

TEST_P(RandomScenes, AreTheSame) {
  const auto [kind, part] = GetParam();
  CaseMaker maker(static_cast<std::uint64_t>(777000 + 10 * static_cast<int>(kind) + part), kind);
  RenderStatistics sum;
  for (int i = 0; i < 2500 / checks::effort && !HasFailure(); ++i) {
    SCOPED_TRACE("scene " + std::to_string(i) + " of this seed");
    const checks::Case c = maker.make();
    RenderOptions options;
    options.threads = 1;
    options.channels = i % 10 == 0 ? every_channel : quick_channels;
    options.cull = i % 7 == 0 ? Cull::back : i % 7 == 1 ? Cull::front : Cull::none;
    add(sum, expect_same(c.scene, c.camera, options));
  }
  if (checks::effort > 1) return;
  // Every tier was reached.
  EXPECT_GT(sum.exact_setups, 100U / checks::effort);
  EXPECT_GT(sum.edges.exact, 100U / checks::effort);
  if (kind == Kind::neighbours) {
    EXPECT_GT(sum.double_words, 100U / checks::effort);
  }
  if (kind == Kind::few_bits) {
    EXPECT_GT(sum.grid_setups, 100U / checks::effort);
  }
  EXPECT_GT(sum.visibility.exact, 100U / checks::effort);
  EXPECT_GT(sum.facing.exact, 100U / checks::effort);
  EXPECT_GT(sum.same_plane, 100U / checks::effort);
  EXPECT_GT(sum.range.exact, 10U / checks::effort);
  EXPECT_GT(sum.coverage_rounding.interval, 1000U / checks::effort);
  EXPECT_GT(sum.coverage_rounding.exact, 100U / checks::effort);
  if (kind == Kind::few_bits || kind == Kind::neighbours) {
    EXPECT_GT(sum.facing.interval, 100U / checks::effort);
    EXPECT_GT(sum.rounding.interval, 100U / checks::effort);
    EXPECT_GT(sum.double_word_roundings, 100U / checks::effort);
  } else {
    EXPECT_GT(sum.rounding.exact, 100U / checks::effort);
  }
}

INSTANTIATE_TEST_SUITE_P(Fast, RandomScenes,
                         ::testing::Combine(::testing::Values(Kind::few_bits, Kind::neighbours,
                                                              Kind::huge, Kind::tiny),
                                            ::testing::Range(0, 3)));

TEST(Fast, TrianglesAcrossTilesOfAnyNumberOfThreads) {
  std::mt19937_64 random(4711);
  RenderStatistics sum;
  for (int i = 0; i < 24 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Scene scene = soup(random, 60, i % 2 == 0);
    const Camera camera = checks::camera_of(160, 140, 64);
    RenderOptions options;
    options.channels = quick_channels;
    options.threads = i % 3 == 0 ? 1 : i % 3 == 1 ? 2 : 5;
    add(sum, expect_same(scene, camera, options));
  }
  EXPECT_GT(sum.grid_setups, 500U / checks::effort);
  EXPECT_GT(sum.visibility.exact, 5U);
  EXPECT_GT(sum.rounding.interval, 100000U / checks::effort);
}

TEST(Fast, LongThinTriangles) {
  std::mt19937_64 random(4714);
  for (int i = 0; i < 24 / checks::effort && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Scene scene = checks::slivers(random, 120);
    Camera camera = checks::camera_of(160, 140, 64);
    if (i % 3 == 1) camera.world_to_camera[2][3] = -2.5;  // among them
    if (i % 4 == 1) camera.far = 2.5;
    RenderOptions options;
    options.channels = i % 6 == 5 ? std::vector{Channel::Z, Channel::A} : quick_channels;
    options.fast.early_rejection = i % 5 != 4;
    expect_same(scene, camera, options);
  }
}

/// Wider bounds leave the map as it is and more pixels to exact numbers, those from before
/// included.
TEST(Fast, WiderBoundsGiveTheSameMapAndMoreDoubt) {
  std::mt19937_64 random(4713);
  for (int i = 0; i < 6 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Scene scene = soup(random, 60, i % 2 == 0);
    const Camera camera = checks::camera_of(160, 140, 64);
    std::set<std::uint64_t> before;
    for (const double widening : {1.0, 0x1p10, 0x1p24}) {
      SCOPED_TRACE(widening);
      RenderOptions options;
      options.channels = quick_channels;
      options.fast.widening = widening;
      options.fast.find_doubtful = true;
      if (widening == 0x1p10) expect_same(scene, camera, options);
      const std::vector<std::uint64_t> doubtful = render_fast(scene, camera, options).doubtful;
      const std::set<std::uint64_t> now(doubtful.begin(), doubtful.end());
      EXPECT_TRUE(std::includes(now.begin(), now.end(), before.begin(), before.end()));
      EXPECT_TRUE(widening == 1 || now.size() > before.size());
      before = now;
    }
    EXPECT_LT(*before.rbegin(), 160U * 140U);
  }
}

TEST(Fast, TheCameraInsideASoup) {
  std::mt19937_64 random(4712);
  RenderStatistics sum;
  for (int i = 0; i < 12 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Scene scene = soup(random, 150, i % 2 == 0);
    Camera camera = checks::camera_of(90, 70, 40);
    camera.projection.cx += 0.125;
    camera.world_to_camera[2][3] = -3.5 - 0.25 * i;
    camera.world_to_camera[0][2] = 0.25;
    if (i % 3 == 1) camera.near = 0.5;
    if (i % 3 == 2) camera.far = 2;
    RenderOptions options;
    options.channels = quick_channels;
    options.cull = i % 4 == 3 ? Cull::back : Cull::none;
    add(sum, expect_same(scene, camera, options));
  }
  EXPECT_GT(sum.exact_setups, 20U);
  EXPECT_GT(sum.rounding.interval, 10000U / checks::effort);
}

TEST(Fast, OrthographicWithDepthsOnTheLimits) {
  std::mt19937_64 random(4713);
  RenderStatistics sum;
  for (int i = 0; i < 12 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Scene scene = soup(random, 50, i % 2 == 0);
    Camera camera = checks::camera_of(100, 70, 8);
    camera.projection.model = ProjectionModel::orthographic;
    camera.projection.cx = 50.5;
    camera.world_to_camera[2][3] = i % 2 == 0 ? -3 : 0;  // faces at depth 0 count nothing
    if (i % 3 == 1) camera.near = 1;
    if (i % 3 == 2) camera.far = 4;
    if (i % 4 == 0) camera.world_to_camera[0][0] = -1;
    RenderOptions options;
    options.channels = quick_channels;
    add(sum, expect_same(scene, camera, options));
  }
  EXPECT_GT(sum.range.exact, 100U / checks::effort);
}

/// Copies of one triangle and others in its plane, in an order of numbers that is not theirs.
TEST(Fast, CoplanarStacks) {
  std::mt19937_64 random(4714);
  RenderStatistics sum;
  for (int i = 0; i < 20 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    std::vector<MeshPoint> vertices;
    std::vector<CornerIndices> triangles;
    const auto number = [&](int n) {
      return static_cast<double>(random() % static_cast<unsigned>(n));
    };
    const double a = (number(9) - 4) / 16, b = (number(9) - 4) / 16;
    for (int k = 0; k < 12; ++k) {
      const double x = number(33) / 8 - 2, y = number(33) / 8 - 2;
      vertices.push_back({x, y, 4 + a * x + b * y});  // exact: all lie in one plane
    }
    for (int t = 0; t < 10; ++t) {
      CornerIndices corners;
      for (std::uint32_t& c : corners) c = static_cast<std::uint32_t>(random() % 12);
      triangles.push_back(corners);
      if (t % 3 == 0) triangles.push_back({corners[1], corners[2], corners[0]});
      if (t % 3 == 1) triangles.push_back({corners[1], corners[0], corners[2]});
    }
    RenderOptions options;
    options.channels = quick_channels;
    add(sum,
        expect_same(checks::scene_of(vertices, triangles), checks::camera_of(64, 48, 41), options));
  }
  EXPECT_GT(sum.same_plane, 1000U / checks::effort);
}

/// Needles: two corners next to each other, one ulp apart, and a third far away.
TEST(Fast, SliversOneUlpWide) {
  std::mt19937_64 random(4715);
  RenderStatistics sum;
  for (int i = 0; i < 200 / checks::effort && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    std::vector<MeshPoint> vertices;
    std::vector<CornerIndices> triangles;
    const auto sample = [&](int n) {
      return (static_cast<double>(random() % static_cast<unsigned>(n)) - n / 2 + 0.5) / 16;
    };
    for (std::uint32_t t = 0; t < 12; ++t) {
      const MeshPoint A{sample(16), sample(16), 1};
      MeshPoint B = A;
      for (double* c : {&B.x, &B.y, &B.z}) {
        if (random() % 2) *c = std::nextafter(*c, random() % 2 ? 9 : -9);
      }
      vertices.insert(vertices.end(), {A, B, {sample(16), sample(16), 1}});
      triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    RenderOptions options;
    options.channels = quick_channels;
    add(sum,
        expect_same(checks::scene_of(vertices, triangles), checks::camera_of(16, 16, 16), options));
  }
  EXPECT_GT(sum.exact_setups, 100U / checks::effort);
  EXPECT_GT(sum.edges.exact, 100U / checks::effort);
}

/// A grid of squares whose corners are samples, with shared vertices: every edge is on samples.
TEST(Fast, AGridOnTheSamples) {
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (std::uint32_t y = 0; y <= 40; ++y) {
    for (std::uint32_t x = 0; x <= 40; ++x) {
      vertices.push_back({x * 2.0 + 0.5, y * 2.0 + 0.5, 5.0 + (x * y) % 3});
      if (x < 40 && y < 40) {
        const std::uint32_t at = y * 41 + x;
        triangles.push_back({at, at + 1, at + 41});
        triangles.push_back({at + 1, at + 42, at + 41});
      }
    }
  }
  Camera camera = checks::camera_of(84, 84, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0;
  RenderOptions options;
  options.channels = quick_channels;
  const RenderStatistics statistics =
      expect_same(checks::scene_of(vertices, triangles), camera, options);
  EXPECT_EQ(statistics.pixels_with_surface, 80U * 80U);
}

/// A sphere of `rings` × 2·rings quads.
TEST(Fast, PlacedObjectsFromOutsideAndInside) {
  const Scene scene = two_spheres(24);
  RenderOptions options;
  options.channels = quick_channels;
  for (const Vector3& eye : {Vector3{3, 1, 2}, Vector3{0.1, 0.2, 0.3}, Vector3{0.9, 0.1, 0.35}}) {
    const Camera camera = look_at(eye, {0.4, 0, 0.1}, {0, 1, 0}, {.width = 150, .height = 130});
    const RenderStatistics statistics = expect_same(scene, camera, options);
    EXPECT_GT(statistics.pixels_with_surface, 1000U);
    EXPECT_LT(statistics.rounding.exact, 20U);  // the bounds settle nearly everything
  }
}

TEST(Fast, EveryChannelAndEncodingOfTwoSpheres) {
  const Scene scene = two_spheres(24);
  const Camera camera = look_at({3, 1, 2}, {0.4, 0, 0.1}, {0, 1, 0}, {.width = 70, .height = 66});
  RenderOptions options;
  options.channels = every_channel;
  expect_same(scene, camera, options);
  options.channels = {Channel::Z, Channel::distance};
  options.depth_encoding.type = DepthEncoding::Type::binary64;
  expect_same(scene, camera, options);
  options.depth_encoding = {DepthEncoding::Type::scaled_unorm16, 7000};
  expect_same(scene, camera, options);
  options.channels = {Channel::id};
  expect_same(scene, camera, options);
}

TEST(Fast, TheSamePixelIsNamedWhereAnEncodingCannotHoldADepth) {
  const Scene scene = two_spheres(24);
  const Camera camera = look_at({3, 1, 2}, {0.4, 0, 0.1}, {0, 1, 0}, {.width = 150, .height = 130});
  RenderOptions options;
  options.threads = 3;
  options.depth_encoding = {DepthEncoding::Type::scaled_unorm16, 20000};
  std::string messages[2];
  for (const bool fast : {false, true}) {
    try {
      fast ? render_fast(scene, camera, options) : render_reference(scene, camera, options);
    } catch (const OutputError& error) {
      messages[fast] = error.what();
    }
  }
  EXPECT_NE(messages[0], "");
  EXPECT_EQ(messages[1], messages[0]);
}

TEST(Fast, TheSamePixelsAreNoneWhereDepthsBeyondTheCodesAre) {
  const Scene scene = two_spheres(24);
  const Camera camera = look_at({3, 1, 2}, {0.4, 0, 0.1}, {0, 1, 0}, {.width = 150, .height = 130});
  RenderOptions options;
  options.channels = {Channel::Z, Channel::distance, Channel::id};
  options.depth_encoding = {DepthEncoding::Type::scaled_unorm16, 20000, true};
  expect_same(scene, camera, options);
  options.engine = Engine::reference;
  const DepthMap truth = render(scene, camera, options).map;
  options.engine = Engine::fast;
  const DepthMap fast = render(scene, camera, options).map;
  std::uint64_t surfaces = 0, codes = 0;
  for (const std::uint32_t id : *truth.values<std::uint32_t>("id")) surfaces += id != no_surface;
  for (const std::uint16_t code : *truth.values<std::uint16_t>("distance")) codes += code != 0;
  EXPECT_GT(codes, 0U);
  EXPECT_GT(surfaces, codes);
  EXPECT_EQ(truth.codes_beyond, surfaces - codes);
  EXPECT_EQ(fast.codes_beyond, surfaces - codes);
  // Where nothing lies beyond, that is said too.
  options.depth_encoding.scale = 1000;
  EXPECT_EQ(render(scene, camera, options).map.codes_beyond, 0U);
  options.depth_encoding.beyond_is_none = false;
  EXPECT_EQ(render(scene, camera, options).map.codes_beyond, std::nullopt);
}

TEST(Fast, AnEmptySceneAndAnImageOfOnePixel) {
  RenderOptions options;
  options.channels = every_channel;
  expect_same({}, checks::camera_of(3, 2, 1), options);
  expect_same(checks::scene_of({}, {}), checks::camera_of(3, 2, 1), options);
  const Scene one = checks::scene_of({{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}}, {{0, 1, 2}});
  EXPECT_EQ(expect_same(one, checks::camera_of(1, 1, 1), options).pixels_with_surface, 1U);
}

}  // namespace
}  // namespace fathom
