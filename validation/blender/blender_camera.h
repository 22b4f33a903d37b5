#pragma once

#include <array>

#include "fathom/camera/camera.h"

namespace fathom::validation {

/// A camera in Blender's terms (docs/conventions.md). Blender keeps all of it in binary32.
struct BlenderCamera {
  bool perspective = true;
  /// Perspective: the focal length in millimetres, for a sensor 36 mm wide, fitted to the image's
  /// width. Orthographic: the width of the image in scene units.
  double lens = 0, ortho_scale = 0;
  /// In widths of the image.
  double shift_x = 0, shift_y = 0;
  double aspect_x = 1, aspect_y = 1;
  /// Camera to world, row by row; the camera's axes are Blender's: x right, y up, −z forward.
  std::array<double, 16> world_from_camera{};
};

/// Fails    InputError if Blender cannot express the camera: skew, an R that is not a rotation (up
///          to 10⁻⁶), mirrored axes, pixels more than twice as wide as high or the reverse.
BlenderCamera blender_camera(const Camera& camera);

}  // namespace fathom::validation
