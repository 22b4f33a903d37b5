// Every channel and encoding of the fast engine: the same bits as the reference engine's, and each
// tier of the cascade reached.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <filesystem>

#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/read_scene.h"
#include "fathom/threads/threads.h"
#include "tests/effort.h"
#include "tests/engines/expect_same_map.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/spheres.h"
#include "tests/places.h"

namespace fathom {
namespace {

using checks::CaseMaker;
using checks::every_channel;
using checks::expect_same_map;
using checks::Kind;

/// What is rendered, or the message of the failure.
struct Outcome {
  Rendered rendered;
  std::string failure;
};

template <class Render>
Outcome outcome_of(const Render& render) {
  Outcome outcome;
  try {
    outcome.rendered = render();
  } catch (const OutputError& error) {
    outcome.failure = error.what();
  }
  return outcome;
}

/// Renders with both engines and compares maps or failures; returns the fast engine's statistics.
RenderStatistics expect_same_outcome(const Scene& scene, const Camera& camera,
                                     const RenderOptions& options) {
  const Outcome truth = outcome_of([&] { return render_reference(scene, camera, options); });
  const Outcome ours = outcome_of([&] { return render_fast(scene, camera, options); });
  EXPECT_EQ(ours.failure, truth.failure);
  if (truth.failure.empty() && ours.failure.empty())
    expect_same_map(ours.rendered.map, truth.rendered.map);
  return ours.rendered.statistics;
}

const std::vector<Channel> depth_channels{Channel::Z, Channel::Zlow, Channel::distance};

/// Every channel as binary32, then Z, distance (and Zlow) in the other encodings.
RenderStatistics expect_same_in_every_encoding(const Scene& scene, const Camera& camera,
                                               double scale, int threads = 1) {
  RenderOptions options;
  options.threads = threads;
  options.channels = every_channel;
  RenderStatistics sum = expect_same_outcome(scene, camera, options);
  options.channels = depth_channels;
  options.depth_encoding.type = DepthEncoding::Type::binary64;
  add(sum, expect_same_outcome(scene, camera, options));
  options.depth_encoding = {DepthEncoding::Type::scaled_unorm16, scale};
  add(sum, expect_same_outcome(scene, camera, options));
  return sum;
}

/// A placement with entries of few bits, flat now and then.
WorldFromMesh placement(std::mt19937_64& random) {
  const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
  WorldFromMesh placed;
  const bool turned = below(3) == 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const bool used = turned || k == 3 || i == k;
      placed.rows[i][k] = used ? (below(9) - 4) / 2.0 : 0;
    }
    if (!turned && below(8) != 0) placed.rows[i][i] = below(2) ? 0.75 : -2;
  }
  return placed;
}

class RandomChannels : public ::testing::TestWithParam<std::tuple<Kind, int>> {};

TEST_P(RandomChannels, AreTheSameInEveryChannel) {
  const auto [kind, part] = GetParam();
  const auto seed = static_cast<std::uint64_t>(880000 + 10 * static_cast<int>(kind) + part);
  CaseMaker maker(seed, kind);
  std::mt19937_64 random(seed);
  const double scale = kind == Kind::huge ? 0x1p-490 : kind == Kind::tiny ? 0x1p506 : 1000;
  RenderStatistics sum;
  for (int i = 0; i < 700 / checks::effort && !HasFailure(); ++i) {
    SCOPED_TRACE("scene " + std::to_string(i) + " of this seed");
    checks::Case c = maker.make();
    if (i % 2 == 0) {
      c.scene.objects.push_back(c.scene.objects[0]);
      c.scene.objects[1].placed_as_is = false;
      c.scene.objects[1].world_from_mesh = placement(random);
    }
    add(sum, expect_same_in_every_encoding(c.scene, c.camera, scale));
  }
  if (checks::effort > 1) return;
  // Every tier was reached, where the magnitudes allow more than the last.
  EXPECT_GT(sum.rounding.exact, 50U);
  if (kind == Kind::few_bits || kind == Kind::neighbours) {
    EXPECT_GT(sum.rounding.interval, 50000U);
    EXPECT_GT(sum.double_word_roundings, 10000U);
    EXPECT_LT(sum.rounding.exact, sum.rounding.interval / 20);
  }
}

INSTANTIATE_TEST_SUITE_P(FastChannels, RandomChannels,
                         ::testing::Combine(::testing::Values(Kind::few_bits, Kind::neighbours,
                                                              Kind::huge, Kind::tiny),
                                            ::testing::Range(0, 2)));

/// Coordinates with all 53 bits, of magnitudes from 2⁻¹¹⁰ to 2¹¹⁰: at the ends of what is safe.
TEST(FastChannels, MagnitudesAroundTheSafeOnes) {
  std::mt19937_64 random(881);
  const auto unit = [&] { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1; };
  RenderStatistics sum;
  for (int i = 0; i < 400 / checks::effort && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const double size = std::ldexp(1, static_cast<int>(random() % 221) - 110);
    std::vector<MeshPoint> vertices;
    for (int k = 0; k < 12; ++k) {
      vertices.push_back({unit() * size, unit() * size, (unit() + 2) * size});
      if (i % 5 == 0) vertices.back().x *= 0x1p-95;
    }
    Camera camera = checks::camera_of(6, 5, 4);
    camera.projection.cx += 0.3;
    if (i % 3 == 0) camera.projection.model = ProjectionModel::orthographic;
    if (i % 3 == 0) camera.projection.fx = camera.projection.fy = 4 / size;
    if (i % 4 == 0) camera.world_to_camera[0][3] = size * unit();
    add(sum, expect_same_in_every_encoding(
                 checks::scene_of(vertices, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}}), camera,
                 1000 / size));
  }
  if (checks::effort > 1) return;
  EXPECT_GT(sum.rounding.exact, 1000U);
  EXPECT_GT(sum.rounding.interval - sum.double_word_roundings, 10000U);
  EXPECT_GT(sum.double_word_roundings, 1000U);
}

/// A sphere of `rings` × 2·rings quads.
/// Two placed spheres, and between them an object of no face.
Scene two_spheres() {
  Scene scene = checks::two_spheres(checks::effort > 1 ? 8 : 24);
  scene.meshes.emplace_back();
  Object none{.mesh = 1, .name = "none", .first_face = 7};
  scene.objects.insert(scene.objects.begin() + 1, std::move(none));
  return scene;
}

Camera skewed(Camera camera) {
  camera.projection.skew = 0.37 * camera.projection.fx;
  camera.projection.fx = -camera.projection.fx * 1.3;
  camera.projection.pixel_centre = 0;
  camera.world_to_camera[1][0] += 0.21;
  return camera;
}

/// The reference engine's time is that of pixels.
LensChoice image_size(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint32_t divisor = checks::effort > 1 ? 3 : 1;
  return {.width = width / divisor, .height = height / divisor};
}

TEST(FastChannels, PlacedSpheresFromOutsideAndInsideByPlainAndSkewedCameras) {
  const Scene scene = two_spheres();
  for (const Vector3& eye : {Vector3{3, 1, 2}, Vector3{0.1, 0.2, 0.3}}) {
    const Camera plain = look_at(eye, {0.4, 0, 0.1}, {0, 1, 0}, image_size(61, 53));
    Camera flat = skewed(plain);
    flat.projection.model = ProjectionModel::orthographic;
    flat.projection.fx = -17;
    flat.projection.fy = 19.3;
    flat.projection.skew = 2;
    for (const Camera& camera : {plain, skewed(plain), flat}) {
      const RenderStatistics sum = expect_same_in_every_encoding(scene, camera, 3000, 2);
      EXPECT_GT(sum.pixels_with_surface, 1000U / checks::effort);
      // Nothing is aligned here: next to no value needs exact numbers.
      EXPECT_LT(sum.rounding.exact, 10U);
      EXPECT_GT(sum.rounding.interval - sum.double_word_roundings, 2 * sum.pixels_with_surface);
    }
  }
}

/// The vector code of every target that this processor has.
class EachTarget {
 public:
  static void use(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().DeInit();
  }
  EachTarget() = default;
  EachTarget(const EachTarget&) = delete;
  EachTarget& operator=(const EachTarget&) = delete;
  ~EachTarget() { use(0); }
};

TEST(FastChannels, EveryKindOfVectorInstructions) {
  const EachTarget restores_the_choice;
  const Scene scene = two_spheres();
  const Camera camera = skewed(look_at({3, 1, 2}, {0.4, 0, 0.1}, {0, 1, 0}, image_size(71, 37)));
  Camera flat = camera;
  flat.projection.model = ProjectionModel::orthographic;
  flat.projection.fx = -17;
  flat.projection.fy = 19.3;
  flat.projection.skew = 2;
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  EXPECT_GE(targets.size(), 1U);
  for (const std::int64_t target : targets) {
    SCOPED_TRACE(hwy::TargetName(target));
    EachTarget::use(target);
    expect_same_in_every_encoding(scene, camera, 3000);
    expect_same_in_every_encoding(scene, flat, 3000);
  }
}

/// Counts of a scene that was made so that values are exactly 0, 1 or in the middle of two codes.
RenderStatistics counts(const Scene& scene, const Camera& camera, double scale) {
  const RenderStatistics sum = expect_same_in_every_encoding(scene, camera, scale);
  EXPECT_GT(sum.pixels_with_surface, 100U);
  return sum;
}

/// Rectangle of two triangles.
Scene rectangle(const MeshPoint& a, const MeshPoint& b, const MeshPoint& c, const MeshPoint& d) {
  return checks::scene_of({a, b, c, d}, {{0, 1, 2}, {0, 2, 3}});
}

/// A plane parallel to the image: Zlow is 0, P.Z and two components of N are the same everywhere,
/// depth 2.0625 is in the middle of the codes 2062 and 2063.
TEST(FastChannels, APlaneParallelToTheImageNeedsNoExactNumbers) {
  for (const double z : {2.0625, 2.0, 0.1, 3.7}) {
    const Scene scene =
        rectangle({-1.17, -1.3, z}, {1.21, -1.1, z}, {1.33, 1.27, z}, {-1.41, 1.19, z});
    Camera camera = checks::camera_of(32, 30, 21.3);
    EXPECT_EQ(counts(scene, camera, 1000).rounding.exact, 0U) << z;
    camera.world_to_camera[2][3] = 1.5;
    EXPECT_EQ(counts(scene, camera, 1000).rounding.exact, 0U) << z;
    camera.projection.model = ProjectionModel::orthographic;
    EXPECT_EQ(counts(scene, camera, 1000).rounding.exact, 0U) << z;
  }
}

/// The floor y = 0 and a wall x = 0: coordinates of P that are 0 throughout, normals along axes.
TEST(FastChannels, FloorsAndWallsAtZeroNeedNoExactNumbers) {
  const Scene floor = rectangle({-1.17, 0, 1.3}, {1.21, 0, 1.2}, {1.33, 0, 9.1}, {-1.41, 0, 8.7});
  Camera camera = checks::camera_of(32, 30, 17);
  camera.world_to_camera[1][3] = 0.83;
  EXPECT_EQ(counts(floor, camera, 1000).rounding.exact, 0U);
  Scene placed = floor;
  placed.objects[0].placed_as_is = false;
  placed.objects[0].world_from_mesh.rows[0] = {0.0, 1.0, 0.0, 0.0};
  placed.objects[0].world_from_mesh.rows[1] = {1.25, 0.0, 0.0, 0.5};
  placed.objects[0].world_from_mesh.rows[2] = {0.0, 0.0, 0.7, 0.25};
  camera.world_to_camera[0][3] = -0.72;
  EXPECT_EQ(counts(placed, camera, 1000).rounding.exact, 0U);
}

/// A grid whose vertices and edges lie on samples, seen without perspective: weights are 0 or 1,
/// depths and positions numbers of few bits.
TEST(FastChannels, AGridOnTheSamplesNeedsNoExactNumbers) {
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (std::uint32_t y = 0; y <= 20; ++y) {
    for (std::uint32_t x = 0; x <= 20; ++x) {
      vertices.push_back({x * 2.0 - 20, y * 2.0 - 20, 5.0 + (x * y) % 3});
      if (x < 20 && y < 20) {
        const std::uint32_t at = y * 21 + x;
        triangles.push_back({at, at + 1, at + 21});
        triangles.push_back({at + 1, at + 22, at + 21});
      }
    }
  }
  Camera camera = checks::camera_of(44, 44, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 20.5;
  const Scene scene = checks::scene_of(vertices, triangles);
  const RenderStatistics sum = counts(scene, camera, 1000);
  EXPECT_EQ(sum.rounding.exact, 0U);
  EXPECT_GE(sum.double_word_roundings, sum.pixels_with_surface);
}

/// Vertices on samples, at depths of all 53 bits: depths are binary64 numbers, of which Zlow has up
/// to 29 bits left, a tie now and then.
TEST(FastChannels, DepthsThatAreBinary64NumbersNeedNoExactNumbers) {
  std::mt19937_64 random(883);
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (std::uint32_t y = 0; y <= 40; ++y) {
    for (std::uint32_t x = 0; x <= 40; ++x) {
      vertices.push_back({x - 20.0, y - 20.0, 5 + std::ldexp(random() >> 11, -53)});
      if (x == 40 || y == 40) continue;
      const std::uint32_t at = y * 41 + x;
      triangles.push_back({at, at + 1, at + 41});
      triangles.push_back({at + 1, at + 42, at + 41});
    }
  }
  Camera camera = checks::camera_of(44, 44, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 20.5;
  EXPECT_EQ(counts(checks::scene_of(vertices, triangles), camera, 1000).rounding.exact, 0U);
}

/// Slanted faces whose normals have a component that is 0 because two products cancel.
TEST(FastChannels, NormalsOfPrismsNeedNoExactNumbers) {
  std::mt19937_64 random(882);
  RenderStatistics sum;
  for (int i = 0; i < 40; ++i) {
    const auto number = [&](unsigned n) { return static_cast<double>(random() % n); };
    // Parallel to the y axis through (x0, z0) and (x1, z1), cut obliquely.
    const double x0 = -3 + number(64) / 32, z0 = 2 + number(64) / 32;
    const double x1 = 1 + number(64) / 32, z1 = 2 + number(64) / 32;
    const Scene scene = rectangle({x0, -2 - number(9) / 8, z0}, {x1, -2 - number(9) / 8, z1},
                                  {x1, 2 + number(9) / 8, z1}, {x0, 2 + number(9) / 8, z0});
    RenderOptions options;
    options.channels = {Channel::N};
    add(sum, expect_same_outcome(scene, checks::camera_of(12, 9, 7.1), options));
  }
  EXPECT_GT(sum.pixels_with_surface, 1000U);
  EXPECT_EQ(sum.rounding.exact, 0U);
}

/// The last tier is reached and right: positions that are exactly 0 between coordinates of many
/// bits, codes exactly between two, a normal component that cancels through a placement.
TEST(FastChannels, WhatOnlyExactNumbersSettle) {
  RenderStatistics sum;
  // x = 0 at the middle column of an odd image, although no coordinate has few bits.
  const Scene wall =
      rectangle({-1.1, -1.3, 2.3}, {1.1, -1.3, 2.3}, {1.1, 1.3, 2.9}, {-1.1, 1.3, 2.9});
  Camera camera = checks::camera_of(31, 29, 21.3);
  sum = counts(wall, camera, 1000);
  EXPECT_GT(sum.rounding.exact, 0U);
  EXPECT_LT(sum.rounding.exact, 200U);
}

TEST(FastChannels, TheSamePixelIsNamedWhereAnEncodingCannotHoldADepth) {
  const Scene scene = two_spheres();
  const Camera camera = look_at({3, 1, 2}, {0.4, 0, 0.1}, {0, 1, 0}, {.width = 61, .height = 53});
  for (const double scale : {20000.0, 0.1, 1e300, 1e-300}) {
    for (const Channel channel : {Channel::Z, Channel::distance}) {
      RenderOptions options;
      options.threads = 2;
      options.channels = {channel, Channel::id};
      options.depth_encoding = {DepthEncoding::Type::scaled_unorm16, scale};
      const Outcome truth = outcome_of([&] { return render_reference(scene, camera, options); });
      const Outcome ours = outcome_of([&] { return render_fast(scene, camera, options); });
      EXPECT_NE(truth.failure, "");
      EXPECT_EQ(ours.failure, truth.failure);
    }
  }
}

/// Small scenes made to be hard, in every encoding, each with its cameras beside it.
TEST(FastChannels, HardScenes) {
  const std::filesystem::path folder = test::source_dir() / "data/scenes/hard";
  int scenes = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".obj") continue;
    const std::string name = file.path().stem().string();
    SCOPED_TRACE(name);
    ++scenes;
    Warnings warnings;
    ReadOptions options;
    options.hash = false;
    const Scene scene = read_scene({file.path()}, options, warnings);
    for (const Camera& camera : read_cameras(folder / (name + ".camera.json"))) {
      expect_same_in_every_encoding(scene, camera, 1000);
    }
  }
  EXPECT_GE(scenes, 8);
}

}  // namespace
}  // namespace fathom
