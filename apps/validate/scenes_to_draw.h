#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/shell/console.h"
#include "apps/validate/validate_arguments.h"
#include "validation/scenes/validation_scenes.h"

namespace fathom::app {

/// How each scene is made: anew in every process that draws it.
struct SceneToMake {
  std::string name;
  std::function<validation::ValidationScene()> make;
};

/// The scene of SCENE…, else those of --scene, else all of ours. What is returned refers to the
/// arguments and the console.
/// Fails    UsageError where --scene names one that there is not.
std::vector<SceneToMake> scenes_of(const ValidateArguments& arguments, const Console& console);

}  // namespace fathom::app
