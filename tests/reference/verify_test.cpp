// verify() against maps that are right and maps in which one bit is not.
#include "fathom/reference/verify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_making.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "tests/effort.h"
#include "tests/engines/expect_same_map.h"
#include "tests/inputs/lens_scenes.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/tables_of_directions.h"
#include "tests/places.h"

namespace fathom {
namespace {

using checks::camera_of;
using checks::CaseMaker;
using checks::effort;
using checks::every_channel;
using checks::Kind;
using checks::scene_of;

const std::filesystem::path data = test::source_dir() / "data";

PixelChoice all_pixels(const Camera& camera) {
  return choose_pixels(camera.width, camera.height, std::numeric_limits<std::uint64_t>::max());
}

std::string text_of(const Verification& v) {
  if (!v.first) return "";
  return "(" + std::to_string(v.first->x) + ", " + std::to_string(v.first->y) + ") " +
         v.first->channel + " is " + v.first->found + ", expected " + v.first->expected;
}

void expect_verified(const DepthMap& map, const Scene& scene, const Camera& camera,
                     const RenderOptions& options) {
  const Verification v = verify(map, scene, camera, options, all_pixels(camera));
  EXPECT_EQ(v.verified, std::uint64_t{camera.width} * camera.height);
  EXPECT_EQ(v.differing, 0U);
  EXPECT_EQ(text_of(v), "");
}

/// Two squares at z = 2 and z = 4, the nearer in the left half of 8×6 pixels, background around.
Scene two_squares() {
  return scene_of(
      {{-1, -1, 2}, {0, -1, 2}, {0, 1, 2}, {-1, 1, 2}, {-1, -2, 4}, {3, -2, 4}, {3, 2, 4}},
      {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}});
}

void flip_last_bit(ImageChannel& channel, std::size_t pixel) {
  std::visit(
      [&](auto& values) {
        auto* bytes = reinterpret_cast<unsigned char*>(&values[pixel]);
        bytes[0] ^= 1U;
      },
      channel.values);
}

TEST(ChoosePixels, AsManyAsAskedForAndAlwaysTheSame) {
  for (const std::uint64_t count : {0U, 1U, 7U, 100U, 119U, 120U, 121U, 100000U}) {
    const PixelChoice chosen = choose_pixels(12, 10, count);
    ASSERT_EQ(chosen.size(), 120U);
    EXPECT_EQ(std::count(chosen.begin(), chosen.end(), true),
              static_cast<std::ptrdiff_t>(std::min<std::uint64_t>(count, 120)));
    EXPECT_EQ(chosen, choose_pixels(12, 10, count));
  }
}

/// The first pixels of a choice of three, by Floyd's algorithm over the numbers of the standard's
/// generator: what the documentation promises to stay.
TEST(ChoosePixels, IsTheOneThatIsDocumented) {
  std::mt19937_64 random(20260101);
  std::set<std::uint64_t> expected;
  for (std::uint64_t last = 97; last < 100; ++last) {
    const std::uint64_t pixel = random() % (last + 1);
    if (!expected.insert(pixel).second) expected.insert(last);
  }
  const PixelChoice chosen = choose_pixels(10, 10, 3);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(chosen[i], expected.count(i) == 1) << i;
}

/// Every pixel of a small image is chosen about as often as any other, over choices of different
/// sizes: expected 99·1/2·… = 49.5 times on average, and none is forgotten.
TEST(ChoosePixels, ReachesEveryPixel) {
  std::vector<int> times(100, 0);
  for (std::uint64_t count = 1; count < 100; ++count) {
    const PixelChoice chosen = choose_pixels(10, 10, count);
    for (std::size_t i = 0; i < 100; ++i) times[i] += chosen[i] ? 1 : 0;
  }
  for (std::size_t i = 0; i < 100; ++i) EXPECT_GT(times[i], 10) << i;
}

TEST(Verify, AgreesWithBothEnginesOnRandomScenes) {
  int cases = 0;
  for (const Kind kind : {Kind::few_bits, Kind::neighbours, Kind::huge, Kind::tiny}) {
    CaseMaker maker(71 + static_cast<std::uint64_t>(kind), kind);
    for (int i = 0; i < 400 / effort; ++i, ++cases) {
      const checks::Case c = maker.make();
      RenderOptions options;
      options.channels = every_channel;
      options.cull = i % 5 == 0 ? Cull::back : i % 5 == 1 ? Cull::front : Cull::none;
      options.threads = 1 + i % 3;
      expect_verified(i % 2 == 0 ? render_fast(c.scene, c.camera, options).map
                                 : render_reference(c.scene, c.camera, options).map,
                      c.scene, c.camera, options);
      if (::testing::Test::HasFailure()) FAIL() << "case " << i << " of seed 71 + kind";
    }
  }
  EXPECT_GE(cases, 80);
}

std::vector<Channel> channels_of_lenses() {
  std::vector<Channel> channels = every_channel;
  std::erase(channels, Channel::A);
  channels.push_back(Channel::valid);
  return channels;
}

/// A random scene under each of some lens models, and one under a table.
std::vector<checks::Case> lens_cases(std::uint64_t seed) {
  std::vector<checks::Case> cases;
  checks::LensCaseMaker maker(seed, Kind::few_bits);
  for (const LensModel model : {LensModel::radial, LensModel::opencv, LensModel::division,
                                LensModel::fisheye_stereographic}) {
    cases.push_back(maker.make(model).view);
  }
  checks::Case with_table = cases.back();
  with_table.camera =
      checks::with_table(with_table.camera, checks::DirectionMaker(seed).numbers(30));
  cases.push_back(with_table);
  return cases;
}

TEST(Verify, AgreesUnderLenses) {
  for (std::uint64_t seed = 0; seed < 60 / effort; ++seed) {
    for (const checks::Case& c : lens_cases(seed)) {
      SCOPED_TRACE(seed);
      RenderOptions options;
      options.channels = channels_of_lenses();
      options.cull = seed % 5 == 0 ? Cull::back : Cull::none;
      options.threads = 1 + static_cast<int>(seed % 3);
      expect_verified(render_reference(c.scene, c.camera, options).map, c.scene, c.camera, options);
    }
  }
}

TEST(Verify, FindsOneBitUnderLenses) {
  for (const checks::Case& c : lens_cases(7)) {
    RenderOptions options;
    options.channels = channels_of_lenses();
    const DepthMap right = render_reference(c.scene, c.camera, options).map;
    for (std::size_t k = 0; k < right.channels.size(); ++k) {
      DepthMap wrong = right;
      flip_last_bit(wrong.channels[k], 8);
      const Verification v = verify(wrong, c.scene, c.camera, options, all_pixels(c.camera));
      ASSERT_EQ(v.differing, 1U);
      EXPECT_EQ(v.first->channel, right.channels[k].name);
      EXPECT_EQ(v.first->x, 8 % c.camera.width);
    }
  }
}

/// A few pixels of a larger image: what is not chosen is not looked at.
TEST(Verify, ChosenPixelsUnderALens) {
  const Scene scene = two_squares();
  Camera camera = camera_of(64, 48, 20);
  camera.projection.lens = Lens{LensModel::simple_radial, {-0.1}};
  RenderOptions options;
  options.channels = channels_of_lenses();
  DepthMap map = render_reference(scene, camera, options).map;
  PixelChoice chosen(std::size_t{64} * 48, false);
  for (std::size_t pixel = 3; pixel < chosen.size(); pixel += 97) chosen[pixel] = true;
  EXPECT_EQ(verify(map, scene, camera, options, chosen).differing, 0U);
  flip_last_bit(map.channels[0], 4);
  EXPECT_EQ(verify(map, scene, camera, options, chosen).differing, 0U);
  flip_last_bit(map.channels[0], 3 + 97 * 15);
  EXPECT_EQ(verify(map, scene, camera, options, chosen).differing, 1U);
}

TEST(Verify, AgreesOnHardScenes) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(data / "scenes" / "hard")) {
    if (entry.path().extension() != ".obj") continue;
    SCOPED_TRACE(entry.path().filename().string());
    Warnings warnings;
    const Scene scene = read_scene({entry.path()}, {}, warnings);
    const std::string name = entry.path().stem().string() + ".camera.json";
    for (const Camera& camera : read_cameras(entry.path().parent_path() / name)) {
      RenderOptions options;
      options.channels = every_channel;
      expect_verified(render_fast(scene, camera, options).map, scene, camera, options);
    }
    ++scenes;
  }
  EXPECT_GE(scenes, 8);
}

TEST(Verify, SceneOfSeveralObjectsAndPlacements) {
  Warnings warnings;
  const auto placed = checks::effort > 1 ? data / "meshes" / "house.gltf"  // has few triangles
                                         : data / "scenes" / "pair.json";
  const Scene scene = read_scene({placed, data / "meshes" / "cube.obj"}, {}, warnings);
  ASSERT_GT(scene.objects.size(), 1U);
  const Camera camera = frame_scene(scene, {}, {.width = 96, .height = 64});
  RenderOptions options;
  options.channels = every_channel;
  expect_verified(render_fast(scene, camera, options).map, scene, camera, options);
}

TEST(Verify, EveryEncoding) {
  const Scene scene = two_squares();
  const Camera camera = camera_of(8, 6, 4);
  for (const auto type : {DepthEncoding::Type::binary32, DepthEncoding::Type::binary64,
                          DepthEncoding::Type::scaled_unorm16}) {
    RenderOptions options;
    options.channels = {Channel::Z, Channel::distance};
    options.depth_encoding = {.type = type, .scale = 1000.5};
    DepthMap map = render_fast(scene, camera, options).map;
    expect_verified(map, scene, camera, options);
    flip_last_bit(map.channels[1], 2 * 8 + 3);
    const Verification v = verify(map, scene, camera, options, all_pixels(camera));
    EXPECT_EQ(v.differing, 1U);
    EXPECT_EQ(text_of(v).substr(0, 16), "(3, 2) distance ");
  }
}

/// Every channel, at a pixel of each surface and of the background: one bit is enough.
TEST(Verify, FindsASingleWrongBit) {
  const Scene scene = two_squares();
  const Camera camera = camera_of(8, 6, 4);
  RenderOptions options;
  options.channels = every_channel;
  const DepthMap right = render_fast(scene, camera, options).map;
  std::size_t corrupted = 0;
  for (std::size_t k = 0; k < right.channels.size(); ++k) {
    for (std::size_t pixel = 0; pixel < 48; ++pixel) {
      DepthMap wrong = right;
      flip_last_bit(wrong.channels[k], pixel);
      const Verification v = verify(wrong, scene, camera, options, all_pixels(camera));
      ASSERT_TRUE(v.first) << right.channels[k].name << " of pixel " << pixel;
      EXPECT_EQ(v.differing, 1U);
      EXPECT_EQ(v.verified, 48U);
      EXPECT_EQ(v.first->channel, right.channels[k].name);
      EXPECT_EQ(v.first->y * 8 + v.first->x, pixel);
      ++corrupted;
    }
  }
  std::size_t parts = 0;
  for (const Channel channel : every_channel) parts += part_names(channel).size();
  EXPECT_EQ(corrupted, parts * 48);
}

TEST(Verify, NamesTheFirstPixelAndBothValues) {
  const Scene scene = two_squares();
  const Camera camera = camera_of(8, 6, 4);
  const RenderOptions options;
  DepthMap map = render_fast(scene, camera, options).map;
  auto& depth = std::get<Samples<float>>(map.channels[0].values);
  depth[4 * 8 + 7] = 3;
  depth[3 * 8 + 2] = std::nextafter(2.0F, 3.0F);
  const Verification v = verify(map, scene, camera, options, all_pixels(camera));
  EXPECT_EQ(v.differing, 2U);
  EXPECT_EQ(text_of(v), "(2, 3) Z is 2.00000024 = 0x1.000002p+1, expected 2 = 0x1p+1");
}

/// A surface that was lost, one that is not there, and the farther of two.
TEST(Verify, FindsWrongVisibility) {
  const Scene scene = two_squares();
  const Camera camera = camera_of(8, 6, 4);
  RenderOptions options;
  options.channels = {Channel::id};
  const DepthMap right = render_fast(scene, camera, options).map;
  const auto& ids = std::get<Samples<std::uint32_t>>(right.channels[0].values);
  std::set<std::uint32_t> seen(ids.begin(), ids.end());
  EXPECT_EQ(seen, (std::set<std::uint32_t>{0, 1, 2, no_surface}));
  for (const std::uint32_t other : seen) {
    DepthMap wrong = right;
    auto& values = std::get<Samples<std::uint32_t>>(wrong.channels[0].values);
    values = Samples<std::uint32_t>(48, other);
    const Verification v = verify(wrong, scene, camera, options, all_pixels(camera));
    EXPECT_EQ(v.differing, 48U - static_cast<unsigned>(std::count(ids.begin(), ids.end(), other)));
  }
}

/// Culling and the range of depths are part of the truth.
TEST(Verify, KnowsCullingAndRange) {
  const Scene scene = two_squares();
  Camera camera = camera_of(8, 6, 4);
  RenderOptions options;
  const DepthMap plain = render_fast(scene, camera, options).map;
  options.cull = Cull::back;
  const DepthMap back = render_fast(scene, camera, options).map;
  options.cull = Cull::front;
  const DepthMap front = render_fast(scene, camera, options).map;
  EXPECT_EQ(verify(front, scene, camera, options, all_pixels(camera)).differing, 0U);
  EXPECT_GT(verify(back, scene, camera, options, all_pixels(camera)).differing, 0U);
  options.cull = Cull::back;
  EXPECT_EQ(verify(back, scene, camera, options, all_pixels(camera)).differing, 0U);
  EXPECT_GT(verify(front, scene, camera, options, all_pixels(camera)).differing, 0U);
  options.cull = Cull::none;
  camera.near = 2.5;
  EXPECT_GT(verify(plain, scene, camera, options, all_pixels(camera)).differing, 0U);
  EXPECT_EQ(
      verify(render_fast(scene, camera, options).map, scene, camera, options, all_pixels(camera))
          .differing,
      0U);
}

/// Only the chosen pixels are looked at.
TEST(Verify, LooksAtTheChosenPixelsAlone) {
  const Scene scene = two_squares();
  const Camera camera = camera_of(8, 6, 4);
  const RenderOptions options;
  const DepthMap right = render_fast(scene, camera, options).map;
  for (const std::uint64_t count : {1U, 5U, 20U}) {
    const PixelChoice chosen = choose_pixels(8, 6, count);
    for (std::size_t pixel = 0; pixel < 48; ++pixel) {
      DepthMap wrong = right;
      flip_last_bit(wrong.channels[0], pixel);
      const Verification v = verify(wrong, scene, camera, options, chosen);
      EXPECT_EQ(v.verified, count);
      EXPECT_EQ(v.differing, chosen[pixel] ? 1U : 0U);
    }
  }
}

/// A code where the depth fits none is a disagreement.
TEST(Verify, ADepthWithoutACode) {
  const Scene scene = two_squares();
  const Camera camera = camera_of(8, 6, 4);
  RenderOptions options;
  options.depth_encoding = {.type = DepthEncoding::Type::scaled_unorm16, .scale = 1000};
  const DepthMap map = render_fast(scene, camera, options).map;
  options.depth_encoding.scale = 33000;
  const Verification v = verify(map, scene, camera, options, all_pixels(camera));
  ASSERT_TRUE(v.first);
  const auto background =
      std::count(std::get<Samples<std::uint16_t>>(map.channels[0].values).begin(),
                 std::get<Samples<std::uint16_t>>(map.channels[0].values).end(), 0);
  EXPECT_EQ(v.differing, 48U - static_cast<unsigned>(background));
  EXPECT_NE(text_of(v).find("above 65535"), std::string::npos) << text_of(v);
}

}  // namespace
}  // namespace fathom
