#include "apps/study/course/aliasing.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "apps/study/antialiasing/curve.h"
#include "apps/study/pipeline_scenes.h"
#include "fathom/render_by_pipeline.h"
#include "fathom/scene/motion.h"

namespace fathom::studies {
namespace {

using pipeline::PipelineOptions;

constexpr std::uint32_t wheel_side = 96, course_spokes = 12;
constexpr double hub = wheel_side / 2.0;

/// Dark, the first spoke red.
Scene spoked_wheel() {
  Scene scene = siemens_star(course_spokes, hub - 2, hub, hub);
  Mesh& mesh = scene.meshes[0];
  // The middle belongs to all spokes, so that the red one needs one of its own.
  mesh.vertices.push_back(mesh.vertices[0]);
  mesh.triangles[0][0] = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  mesh.colours.assign(mesh.vertices.size(), {0.15F, 0.15F, 0.15F, 1});
  for (const std::uint32_t corner : mesh.triangles[0]) mesh.colours[corner] = {0.8F, 0.1F, 0.1F, 1};
  return scene;
}

/// A keyframe for each degree, about the middle.
StudyFile turning() {
  std::string keyframes;
  for (int degrees = 0; degrees <= wheel_degrees * wheel_pictures; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    keyframes += fmt::format(
        "{}\n  {{\"time\": {}, \"transform\": [[{}, {}, 0, {}], [{}, {}, 0, {}], [0, 0, 1, 0]]}}",
        degrees == 0 ? "" : ",", static_cast<double>(degrees) / wheel_degrees, c, -s,
        hub - c * hub + s * hub, s, c, hub - s * hub - c * hub);
  }
  return {"wheel-motion.json",
          "{\"objects\": [{\"name\": \"wheel\", \"keyframes\": [" + keyframes + "]}]}\n"};
}

PipelineOptions flat_colours() {
  PipelineOptions options;
  options.shading = pipeline::Shading::none;
  options.background = {0.92, 0.92, 0.92};
  return options;
}

struct MovingWheel {
  MovingScene scene;
  Camera camera;
};
MovingWheel moving_wheel() {
  const SceneFiles files = wheel_files();
  const StudyFile& motion = files.files.back();
  return {MovingScene(files.view.scene, read_motion(motion.content, motion.name)),
          files.view.camera};
}

}  // namespace

DrawnCurve curve_at(std::uint32_t size) {
  Scene scene = heart_scene(size, 0.025);
  scene.meshes[0].colours.assign(scene.meshes[0].vertices.size(), {0.16F, 0.31F, 0.63F, 1});
  DrawnCurve result{scene_files("curve-" + std::to_string(size), scene, window_camera(size, size)),
                    {}};
  PipelineOptions options = flat_colours();
  options.background = {1, 1, 1};
  result.picture = pipeline_picture(result.files.view, options);
  return result;
}

SceneFiles wheel_files() {
  SceneFiles result = scene_files("wheel", spoked_wheel(), window_camera(wheel_side, wheel_side));
  result.files.push_back(turning());
  return result;
}

std::vector<RgbImage> wheel_at_instants() {
  MovingWheel wheel = moving_wheel();
  std::vector<RgbImage> pictures;
  for (int time = 0; time < wheel_pictures; ++time) {
    const SceneView view{"wheel", wheel.scene.at(time), wheel.camera};
    pictures.push_back(pipeline_picture(view, flat_colours()));
  }
  return pictures;
}

std::vector<RgbImage> wheel_with_open_shutter() {
  MovingWheel wheel = moving_wheel();
  PipelineOptions options = flat_colours();
  options.antialias = {pipeline::AntialiasMethod::temporal, 16};
  std::vector<RgbImage> pictures;
  for (int time = 0; time < wheel_pictures; ++time) {
    const pipeline::Shutter shutter{static_cast<double>(time), static_cast<double>(time + 1)};
    pictures.push_back(
        render_by_pipeline(wheel.scene, wheel.camera, options, shutter, {}, true).picture);
  }
  return pictures;
}

}  // namespace fathom::studies
