// A render that is right gets no warning: of everything in data/, with the cameras beside it, and
// of the scenes that other renderers are validated on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_import.h"
#include "fathom/render.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"
#include "fathom/scene/view_warnings.h"
#include "tests/places.h"
#include "validation/scenes/validation_scenes.h"

namespace fathom {
namespace {

using Kind = ViewWarning::Kind;

const std::filesystem::path data = test::source_dir() / "data";

Scene scene_from(const std::filesystem::path& file) {
  Warnings warnings;
  ReadOptions options;
  options.hash = false;
  return read_scene({file}, options, warnings);
}

std::vector<Camera> cameras_from(const std::filesystem::path& file) {
  Warnings warnings;
  std::vector<Camera> cameras = read_cameras(file, warnings);
  EXPECT_THAT(warnings, ::testing::IsEmpty());
  return cameras;
}

/// What is warned of when the scene is rendered.
std::vector<ViewWarning> warnings_for(const Scene& scene, const Camera& camera) {
  const RenderStatistics statistics = render(scene, camera).statistics;
  std::vector<ViewWarning> warnings = warnings_of_camera(camera);
  for (ViewWarning& of_view : warnings_of_view(scene, camera, statistics.pixels_with_surface))
    warnings.push_back(std::move(of_view));
  return warnings;
}

void expect_none(const Scene& scene, const Camera& camera) {
  for (const ViewWarning& warning : warnings_for(scene, camera)) ADD_FAILURE() << warning.text;
}

TEST(NoFalseWarnings, OfScenesThatAreFramed) {
  int files = 0;
  for (const char* folder : {"meshes", "scenes"}) {
    for (const auto& entry : std::filesystem::directory_iterator(data / folder)) {
      if (!entry.is_regular_file()) continue;
      SCOPED_TRACE(entry.path().filename().string());
      const Scene scene = scene_from(entry.path());
      ++files;
      LensChoice lens{.width = 201, .height = 131};
      for (const Camera& camera : orbit_scene({.elevation = 10}, 5, scene, lens))
        expect_none(scene, camera);
      lens.model = ProjectionModel::orthographic;
      expect_none(scene, frame_scene(scene, {}, lens));
    }
  }
  EXPECT_GE(files, 15);
}

TEST(NoFalseWarnings, OfTheCamerasInTheData) {
  const Scene spot = scene_from(data / "meshes/spot.obj"),
              pair = scene_from(data / "scenes/pair.json");
  std::vector<Camera> cameras;
  for (const char* name : {"look-at", "orthographic", "calibrated", "opencv", "orbit", "colmap"}) {
    const auto read = cameras_from(data / "cameras" / (std::string(name) + ".json"));
    cameras.insert(cameras.end(), read.begin(), read.end());
  }
  const auto folder = data / "cameras";
  Warnings warnings;
  for (const auto& list :
       {import_colmap(folder / "colmap"), import_nerf(folder / "transforms.json", 0, 0, warnings),
        import_bop(folder / "scene_camera.json", 640, 480), import_opengl(folder / "opengl.json")})
    for (const ImportedCamera& imported : list) cameras.push_back(imported.camera);
  EXPECT_GE(cameras.size(), 18U);
  for (const Camera& camera : cameras) {
    expect_none(spot, camera);
    expect_none(pair, camera);
  }
}

TEST(NoFalseWarnings, OfTheScenesOfValidation) {
  for (const std::string& name : validation::scene_names()) {
    SCOPED_TRACE(name);
    const auto made = validation::make_validation_scene(name, 96, 72);
    expect_none(made.scene, made.camera);
  }
}

/// Three of them have matrices that are no rotations, on purpose: that is all that is said.
TEST(NoFalseWarnings, OfHardScenes) {
  std::set<std::string> with_warnings;
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(data / "scenes" / "hard")) {
    if (entry.path().extension() != ".obj") continue;
    const std::string name = entry.path().stem().string();
    SCOPED_TRACE(name);
    ++scenes;
    const Scene scene = scene_from(entry.path());
    for (const Camera& camera :
         cameras_from(entry.path().parent_path() / (name + ".camera.json"))) {
      for (const ViewWarning& warning : warnings_for(scene, camera)) {
        EXPECT_TRUE(warning.kind == Kind::not_a_rotation || warning.kind == Kind::mirrored)
            << warning.text;
        with_warnings.insert(name);
      }
    }
  }
  EXPECT_GE(scenes, 15);
  EXPECT_EQ(with_warnings, (std::set<std::string>{"camera-centre-underflows",
                                                  "depths-one-ulp-apart", "entry-underflows"}));
}

}  // namespace
}  // namespace fathom
