#pragma once

#include <array>

#include "fathom/camera/camera.h"

namespace fathom::validation {

/// A camera in Blender's words (docs/conventions.md). Blender keeps all of it in binary32.
struct BlenderCamera {
  bool perspective = true;
  /// Sensor fitted to the image's width, which is 36 mm; or the width in scene units.
  double lens = 0, ortho_scale = 0;
  double shift_x = 0, shift_y = 0;
  double aspect_x = 1, aspect_y = 1;
  /// Camera to world with Blender's axes, x right, y up, −z forward, row by row.
  std::array<double, 16> world_from_camera{};
};

/// Fails    InputError where Blender cannot express the camera: skew, R that is no rotation (up to
///          10⁻⁶), mirrored axes, pixels more than twice as wide as high or the reverse.
BlenderCamera blender_camera(const Camera& camera);

}  // namespace fathom::validation
