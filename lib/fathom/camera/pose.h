#pragma once

#include <array>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/ratio.h"

/// Poses with entries that are rounded once. For this room's .cpp files only.
namespace fathom::camera {

using Matrix3 = std::array<std::array<double, 3>, 3>;
using Matrix34 = std::array<std::array<double, 4>, 3>;

/// `v` scaled to length 1, each entry the exact one rounded to nearest. v must not be zero.
std::array<double, 3> unit_vector(const ExactVector3& v);

/// R·X, exactly.
ExactVector3 rotate(const Matrix3& R, const ExactVector3& X);

/// [R | target − R·X]: the pose that takes the world point X to the camera point `target`; its
/// translation is the exact one rounded once.
Matrix34 pose_that_takes(const Matrix3& R, const ExactVector3& X, const ExactVector3& target);

}  // namespace fathom::camera
