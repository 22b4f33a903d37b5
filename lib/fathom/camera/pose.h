#pragma once

#include <array>

#include "fathom/geometry/frames.h"

namespace fathom {

/// Where a camera stands, or another affine map of points: [R | t], 3×4; R need not be a rotation.
/// Every number is the real number that it denotes.
using Pose = std::array<std::array<double, 4>, 3>;

/// det R, exactly.
Dyadic determinant_of_rotation(const Pose& pose);

/// R·X + t, exactly; scene units.
CameraPoint to_camera(const Pose& world_to_camera, const WorldPoint& X);

/// Camera to world, [R⁻¹ | −R⁻¹·t]: each entry is the exact one, rounded to nearest once.
/// Fails    InputError where R is singular.
Pose camera_to_world(const Pose& world_to_camera);

}  // namespace fathom
