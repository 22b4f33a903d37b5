#include "apps/validate/validate_input.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <utility>

#include "apps/options/camera_options.h"
#include "apps/shell/known_files.h"
#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {
namespace {

using validation::ValidationScene;

/// The scene of the command line, with near and far.
ValidationScene named_by_files(const ValidateArguments& arguments, const Console& console) {
  Scene scene = read_files(arguments.scenes, arguments.limits, console);
  Camera camera;
  if (arguments.camera.empty()) {
    const auto [width, height] = arguments.size;
    camera = frame_scene(scene, {}, {.width = width, .height = height});
  } else {
    camera = read_camera(arguments.camera, "", console);
  }
  camera = validation::with_clip_planes(scene, camera);
  return {std::filesystem::path(arguments.scenes.front()).stem(), std::move(scene), camera};
}

}  // namespace

Camera read_camera(const std::string& file, const std::string& map, const Console& console) {
  if (file.empty()) throw UsageError("--camera FILE is missing");
  const std::vector<Camera> cameras = read_camera_file(file, console);
  if (cameras.size() > 1 && !map.empty()) return camera_called_as(map, cameras);
  if (cameras.size() != 1) {
    throw UsageError(fmt::format(
        "{}: is a path of {} cameras; expected a single one, as 'fathom camera import … --image "
        "NAME' writes it, or a map that contains its camera",
        file, cameras.size()));
  }
  return cameras.front();
}

Scene read_files(const std::vector<std::string>& files, const ReadLimits& limits,
                 const Console& console) {
  if (files.empty()) throw UsageError("SCENE is missing: the scene that the map shows");
  for (const std::string& file : files) note_input(file);
  Warnings warnings;
  ReadOptions options = limits.read_options();
  options.hash = false;
  Scene scene = read_scene({files.begin(), files.end()}, options, warnings);
  console.warn(warnings);
  return scene;
}

std::vector<SceneToMake> scenes_of(const ValidateArguments& arguments, const Console& console) {
  if (!arguments.scenes.empty()) {
    for (const std::string& file : arguments.scenes) note_input(file);
    const std::string name = std::filesystem::path(arguments.scenes.front()).stem();
    return {{name, [&arguments, &console] { return named_by_files(arguments, console); }}};
  }
  const auto [width, height] = arguments.size;
  std::vector<SceneToMake> scenes;
  const std::vector<std::string> names =
      arguments.scene_names.empty() ? validation::scene_names() : parse_list(arguments.scene_names);
  scenes.reserve(names.size());
  for (const std::string& name : names) {
    scenes.push_back({name, [name, w = width, h = height] {
                        return validation::make_validation_scene(name, w, h);
                      }});
  }
  return scenes;
}

}  // namespace fathom::app
