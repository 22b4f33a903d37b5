// The fast engine against the reference engine on everything in data/.
#include <gtest/gtest.h>

#include <filesystem>

#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_making.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "tests/effort.h"
#include "tests/engines/expect_same_map.h"
#include "tests/places.h"

namespace fathom {
namespace {

using checks::expect_same;
using checks::quick_channels;

const std::filesystem::path data = test::source_dir() / "data";

Scene scene_from(const std::filesystem::path& file) {
  Warnings warnings;
  ReadOptions options;
  options.hash = false;
  return read_scene({file}, options, warnings);
}

/// Under sanitizers images are smaller: the reference engine's time is that of pixels.
constexpr std::uint32_t divisor = checks::effort > 1 ? 3 : 1;

/// Framed by a perspective and by an orthographic camera, with limits of depth, and from within.
std::vector<Camera> cameras_for(const Scene& scene) {
  LensChoice lens{.width = 201 / divisor, .height = 131 / divisor};
  const Camera framed = frame_scene(scene, {.azimuth = 20, .elevation = 10}, lens);
  Camera limited = frame_scene(scene, {.azimuth = 130, .elevation = -35}, lens);
  const double distance = limited.world_to_camera[2][3];
  limited.near = std::abs(distance) * 0.875;
  limited.far = std::abs(distance) * 1.0625 + limited.near;
  Camera within = frame_scene(scene, {.azimuth = 75, .elevation = 5}, lens);
  within.world_to_camera[2][3] *= 0.125;
  lens.model = ProjectionModel::orthographic;
  return {framed, limited, within, frame_scene(scene, {}, lens)};
}

TEST(FastData, MeshesAndScenesFromSeveralCameras) {
  int files = 0;
  std::uint64_t pixels = 0;
  for (const char* folder : {"meshes", "scenes"}) {
    for (const auto& entry : std::filesystem::directory_iterator(data / folder)) {
      if (!entry.is_regular_file()) continue;
      SCOPED_TRACE(entry.path().filename().string());
      const Scene scene = scene_from(entry.path());
      ++files;
      std::vector<Camera> cameras = cameras_for(scene);
      if (checks::effort > 1) cameras = {cameras[static_cast<std::size_t>(files) % 4]};
      for (const Camera& camera : cameras) {
        RenderOptions options;
        options.channels = quick_channels;
        options.cull = files % 3 == 2 ? Cull::back : Cull::none;
        pixels += expect_same(scene, camera, options).pixels_with_surface;
      }
    }
  }
  EXPECT_GE(files, 6);
  if (checks::effort > 1) return;
  EXPECT_GT(pixels, 50000U);
}

/// Small scenes made to be hard, each with its cameras beside it.
TEST(FastData, HardScenesInEveryChannel) {
  const auto folder = data / "scenes" / "hard";
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".obj") continue;
    const std::string name = entry.path().stem().string();
    SCOPED_TRACE(name);
    ++scenes;
    for (const Camera& camera : read_cameras(folder / (name + ".camera.json"))) {
      RenderOptions options;
      options.channels = checks::every_channel;
      expect_same(scene_from(entry.path()), camera, options);
    }
  }
  EXPECT_GE(scenes, 8);
}

}  // namespace
}  // namespace fathom
