// Scenes that stay in their files: the map of the same files read into memory, bit for bit.
#include "fathom/fast/stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"
#include "fathom/reference/verify.h"
#include "fathom/render.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "tests/adversaries.h"
#include "tests/effort.h"
#include "tests/engines/expect_same_map.h"
#include "tests/inputs/adversarial_scenes.h"
#include "tests/inputs/both_readings.h"
#include "tests/inputs/lens_scenes.h"
#include "tests/inputs/random_scenes.h"
#include "tests/inputs/tables_of_directions.h"
#include "tests/places.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

namespace fs = std::filesystem;
using checks::Both;
using checks::CaseMaker;
using checks::effort;
using checks::expect_same_map;
using checks::Kind;
using checks::ply_of;
using checks::stl_of;
using checks::streamed_channels;

const fs::path data = test::source_dir() / "data";

void expect_same_render(const Both& both, const Camera& camera, const RenderOptions& options,
                        const StreamLimits& limits) {
  SCOPED_TRACE(std::to_string(limits.triangles_at_once) + " triangles at once, " +
               std::to_string(limits.tile_bytes) + " bytes of tiles, " +
               std::to_string(limits.kept_bytes) + " of triangles");
  expect_same_map(render_streamed(both.streamed, camera, options, limits).map,
                  render_fast(both.scene, camera, options).map);
}

/// Under sanitizers images are smaller, unless told otherwise.
std::vector<Camera> cameras_for(const Scene& scene, std::uint32_t divisor = effort > 1 ? 3 : 1) {
  LensChoice lens{.width = 201 / divisor, .height = 150 / divisor};
  const Camera framed = frame_scene(scene, {.azimuth = 20, .elevation = 10}, lens);
  Camera within = frame_scene(scene, {.azimuth = 75, .elevation = 5}, lens);
  within.world_to_camera[2][3] *= 0.125;
  within.far = std::abs(within.world_to_camera[2][3]) + 0.5;
  lens.model = ProjectionModel::orthographic;
  return {framed, within, frame_scene(scene, {}, lens)};
}

TEST(FastStream, MeshesInEveryChannel) {
  const ScratchFolder folder;
  int files = 0;
  for (const char* name : {"spot.obj", "cube.obj", "l-shape.obj", "house.gltf"}) {
    SCOPED_TRACE(name);
    Warnings warnings;
    const Scene scene = read_scene({data / "meshes" / name}, {}, warnings);
    const std::string stem = std::to_string(files++);
    const Both both({folder.write(stem + ".stl", stl_of(scene.meshes.at(0))),
                     folder.write(stem + ".ply", ply_of(scene.meshes.at(0))),
                     data / "meshes" / "cube-big-endian.ply"});
    EXPECT_EQ(both.warnings, both.stream_warnings);
    RenderOptions options;
    options.channels = streamed_channels;
    options.cull = files == 2 ? Cull::back : Cull::none;
    for (const Camera& camera : cameras_for(both.scene)) {
      expect_same_render(both, camera, options, {});
      expect_same_render(both, camera, options,
                         {.triangles_at_once = 100, .tile_bytes = 0, .kept_bytes = 0});
      expect_same_render(both, camera, options,
                         {.triangles_at_once = 997, .tile_bytes = 300000, .kept_bytes = 200000});
      if (effort > 1) break;
    }
  }
}

TEST(FastStream, OneTriangleAtATime) {
  const ScratchFolder folder;
  Warnings warnings;
  const Scene scene = read_scene({data / "meshes" / "l-shape.obj"}, {}, warnings);
  const Both both({folder.write("a.ply", ply_of(scene.meshes.at(0)))});
  for (const Camera& camera : cameras_for(both.scene)) {
    for (const int threads : {1, 3}) {
      RenderOptions options;
      options.channels = checks::quick_channels;
      options.threads = threads;
      expect_same_render(both, camera, options, {.triangles_at_once = 1, .tile_bytes = 0});
    }
  }
}

TEST(FastStream, RandomScenes) {
  const ScratchFolder folder;
  int cases = 0;
  for (const Kind kind : {Kind::few_bits, Kind::neighbours, Kind::huge, Kind::tiny}) {
    CaseMaker maker(91 + static_cast<std::uint64_t>(kind), kind);
    for (int i = 0; i < 200 / effort; ++i, ++cases) {
      SCOPED_TRACE("case " + std::to_string(i) + " of seed 91 + kind");
      const checks::Case c = maker.make();
      const Both both({folder.write(std::to_string(cases) + ".ply", ply_of(c.scene.meshes.at(0)))});
      RenderOptions options;
      options.channels = streamed_channels;
      options.cull = i % 5 == 0 ? Cull::back : Cull::none;
      expect_same_render(both, c.camera, options,
                         {.triangles_at_once = 1U + i % 3, .kept_bytes = i % 2 * 1000000U});
      if (::testing::Test::HasFailure()) return;
    }
  }
  EXPECT_GE(cases, 40);
}

TEST(FastStream, Adversaries) {
  const ScratchFolder folder;
  const std::vector<StreamLimits> limits{{.triangles_at_once = 1, .tile_bytes = 0, .kept_bytes = 0},
                                         {.triangles_at_once = 3, .tile_bytes = 0},
                                         {.triangles_at_once = 2}};
  for (const checks::Family family : checks::all_families) {
    if (family == checks::Family::placements) continue;  // files of meshes place nothing
    checks::for_each_adversary(30, [&](std::uint64_t seed) {
      SCOPED_TRACE(name_of(family));
      const checks::Case c = checks::adversarial_case(family, seed);
      const Both both({folder.write("mesh.ply", ply_of(c.scene.meshes.at(0)))});
      RenderOptions options;
      options.channels = streamed_channels;
      if (seed % 4 == 3) options.cull = Cull::back;
      expect_same_render(both, c.camera, options, limits[seed % limits.size()]);
    });
  }
}

std::vector<Channel> channels_of_lenses() {
  std::vector<Channel> channels = streamed_channels;
  std::erase(channels, Channel::A);
  channels.push_back(Channel::valid);
  return channels;
}

TEST(FastStream, RandomScenesUnderLenses) {
  const ScratchFolder folder;
  std::uint64_t seed = 0;
  for (const LensModel model :
       {LensModel::opencv, LensModel::division, LensModel::fisheye_stereographic}) {
    for (int i = 0; i < 60 / effort; ++i, ++seed) {
      SCOPED_TRACE(seed);
      checks::Case c = checks::LensCaseMaker(seed, Kind::few_bits).make(model).view;
      if (i % 3 == 0)
        c.camera = checks::with_table(c.camera, checks::DirectionMaker(seed).numbers(30));
      const Both both({folder.write(std::to_string(seed) + ".ply", ply_of(c.scene.meshes.at(0)))});
      RenderOptions options;
      options.channels = channels_of_lenses();
      options.cull = i % 5 == 0 ? Cull::back : Cull::none;
      expect_same_render(both, c.camera, options, {.triangles_at_once = 1U + i % 3});
    }
  }
}

// Of several tiles, in one band and in several, and in one view and in several.
TEST(FastStream, MeshesUnderLenses) {
  const ScratchFolder folder;
  Warnings warnings;
  const Scene scene = read_scene({data / "meshes" / "spot.obj"}, {}, warnings);
  const Both both({folder.write("spot.ply", ply_of(scene.meshes.at(0)))});
  RenderOptions options;
  options.channels = channels_of_lenses();
  Camera camera = cameras_for(both.scene).front();
  for (const Lens& lens :
       {Lens{LensModel::opencv, {-0.2, 0.05, 0.001}}, Lens{LensModel::division, {-30}}}) {
    camera.projection.lens = lens;
    expect_same_render(both, camera, options, {});
    expect_same_render(both, camera, options, {.triangles_at_once = 997, .tile_bytes = 0});
  }
}

/// Every encoding, and the failure that names the first pixel.
TEST(FastStream, Encodings) {
  const ScratchFolder folder;
  Warnings warnings;
  const Scene scene = read_scene({data / "meshes" / "spot.obj"}, {}, warnings);
  const Both both({folder.write("spot.stl", stl_of(scene.meshes.at(0)))});
  const Camera camera = cameras_for(both.scene).at(0);
  RenderOptions options;
  options.channels = {Channel::Z, Channel::distance};
  for (const auto type : {DepthEncoding::Type::binary32, DepthEncoding::Type::binary64,
                          DepthEncoding::Type::scaled_unorm16}) {
    options.depth_encoding.type = type;
    expect_same_render(both, camera, options, {.triangles_at_once = 1000, .tile_bytes = 0});
  }
  options.depth_encoding.scale = 1e6;
  const auto failure = [](const auto& work) { return message_of<OutputError>(work); };
  EXPECT_EQ(failure([&] {
              render_streamed(both.streamed, camera, options,
                              {.triangles_at_once = 1000, .tile_bytes = 0});
            }),
            failure([&] { render_fast(both.scene, camera, options); }));
}

/// Decisions about triangles are counted once, however often the files are read.
TEST(FastStream, StatisticsCountTrianglesOnce) {
  const ScratchFolder folder;
  Warnings warnings;
  const Scene scene = read_scene({data / "meshes" / "spot.obj"}, {}, warnings);
  const Both both({folder.write("spot.ply", ply_of(scene.meshes.at(0)))});
  const Camera camera = cameras_for(both.scene, 1).at(1);
  RenderOptions options;
  options.cull = Cull::back;
  std::vector<double> shares;
  const RenderStatistics ours =
      render_streamed(both.streamed, camera, options, {.triangles_at_once = 500, .tile_bytes = 0},
                      {.progress = [&](double share) { shares.push_back(share); }})
          .statistics;
  const RenderStatistics truth = render_fast(both.scene, camera, options).statistics;
  EXPECT_EQ(ours.triangles, truth.triangles);
  EXPECT_EQ(ours.facing.interval + ours.facing.exact, truth.facing.interval + truth.facing.exact);
  EXPECT_EQ(ours.culled_triangles, truth.culled_triangles);
  EXPECT_GT(ours.culled_triangles, 0U);
  EXPECT_EQ(ours.degenerate_triangles, truth.degenerate_triangles);
  EXPECT_EQ(ours.pixels_with_surface, truth.pixels_with_surface);
  // 5856 triangles in twelve parts for each of three rows of tiles, but for those that lie
  // elsewhere; and the end of each row.
  EXPECT_GT(shares.size(), 12U + 3U);
  EXPECT_LT(shares.size(), 3U * 12U + 3U);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
}

/// The front door: what is written beside the channels is the same too.
TEST(FastStream, FrontDoorDescribesTheMap) {
  const ScratchFolder folder;
  const fs::path cube = data / "meshes" / "cube.stl";
  const Both both({cube, data / "meshes" / "cube-little-endian.ply"});
  RenderOptions options;
  options.engine = Engine::fast;
  const Camera camera = frame_scene(outline_of(both.streamed), {}, {.width = 64, .height = 48});
  EXPECT_EQ(to_json(camera), to_json(frame_scene(both.scene, {}, {.width = 64, .height = 48})));
  const DepthMap ours = render(both.streamed, camera, options).map;
  const DepthMap truth = render(both.scene, camera, options).map;
  expect_same_map(ours, truth);
  EXPECT_EQ(texts_of(ours), texts_of(truth));
  EXPECT_EQ(ours.object_names, truth.object_names);
  EXPECT_EQ(ours.object_names, (std::vector<std::string>{"cube", "cube-little-endian"}));
  options.engine = Engine::reference;
  EXPECT_THROW(render(both.streamed, camera, options), UsageError);
}

TEST(FastStream, VerifiedFromTheFilesToo) {
  const ScratchFolder folder;
  Warnings warnings;
  const Scene scene = read_scene({data / "meshes" / "spot.obj"}, {}, warnings);
  const Both both({folder.write("spot.stl", stl_of(scene.meshes.at(0))),
                   folder.write("spot.ply", ply_of(scene.meshes.at(0)))});
  const Camera camera = cameras_for(both.scene).at(0);
  RenderOptions options;
  options.channels = streamed_channels;
  DepthMap map = render_streamed(both.streamed, camera, options).map;
  PixelChoice chosen(map.width * std::size_t{map.height}, false);
  for (std::size_t i = 0; i < chosen.size(); i += 7 * checks::effort) chosen[i] = true;
  const std::size_t within = map.height / 2 * std::size_t{map.width} + map.width / 2;
  chosen[within] = true;
  Verification v = verify(map, both.streamed, camera, options, chosen);
  EXPECT_EQ(v.verified, static_cast<std::size_t>(std::count(chosen.begin(), chosen.end(), true)));
  EXPECT_EQ(v.differing, 0U);
  std::get<Samples<float>>(map.channels[0].values)[within] *= 1.0000001F;
  v = verify(map, both.streamed, camera, options, chosen);
  EXPECT_EQ(v.differing, 1U);
}

}  // namespace
}  // namespace fathom
