#pragma once

#include <string>
#include <vector>

#include "fathom/camera/camera.h"

namespace fathom::app {

/// The text of a transforms.json whose frames have the depth images of their cameras beside them, as
/// Nerfstudio has it: "depth_file_path" of each frame, in the order of the cameras, and
/// "depth_unit_scale_factor", 0.001, of all. Frames without a camera are left out.
/// Fails    InputError where the file cannot be read.
std::string transforms_with_depths(const std::string& file, const std::vector<Camera>& cameras,
                                   const std::vector<std::string>& depths);

}  // namespace fathom::app
