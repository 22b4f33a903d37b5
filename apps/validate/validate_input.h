#pragma once

#include <string>
#include <vector>

#include "apps/options/scene_options.h"
#include "apps/shell/console.h"
#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

/// What a map is compared with, as files: read, and kept from being an output's place.
namespace fathom::app {

/// The single camera of --camera; warnings go to the console.
/// Fails    UsageError where the file is not given or holds a camera path; InputError.
Camera read_camera(const std::string& file, const Console& console);

/// The scene of SCENE…; warnings go to the console.
/// Fails    UsageError where there is none; InputError.
Scene read_files(const std::vector<std::string>& files, const ReadLimits& limits,
                 const Console& console);

}  // namespace fathom::app
