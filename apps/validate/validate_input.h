#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/options/scene_options.h"
#include "apps/shell/console.h"
#include "apps/validate/validate_arguments.h"
#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"
#include "validation/scenes/validation_scenes.h"

/// Input files of a comparison; no output may overwrite them.
namespace fathom::app {

/// The single camera of --camera, or the camera of a path that is called as `map`, the file of
/// --map; empty: there is no such file. Warnings go to the console.
/// Fails    UsageError if the file is not given or has no such camera; InputError.
Camera read_camera(const std::string& file, const std::string& map, const Console& console);

/// The scene of SCENE…; warnings go to the console.
/// Fails    UsageError if SCENE is missing; InputError.
Scene read_files(const std::vector<std::string>& files, const ReadLimits& limits,
                 const Console& console);

/// How each scene is made; every process that draws a scene makes it again.
struct SceneToMake {
  std::string name;
  std::function<validation::ValidationScene()> make;
};

/// The scene of SCENE…, else the scenes of --scene, else all built-in scenes. The result refers to
/// the arguments and the console.
/// Fails    UsageError if --scene names an unknown scene.
std::vector<SceneToMake> scenes_of(const ValidateArguments& arguments, const Console& console);

}  // namespace fathom::app
