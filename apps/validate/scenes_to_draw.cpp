#include "apps/validate/scenes_to_draw.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <utility>

#include "apps/shell/known_files.h"
#include "apps/validate/validate_input.h"
#include "fathom/camera/camera_making.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/framing.h"

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
    camera = read_camera(arguments.camera, console);
  }
  camera = validation::with_clip_planes(scene, camera);
  return {std::filesystem::path(arguments.scenes.front()).stem(), std::move(scene), camera};
}

}  // namespace

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
