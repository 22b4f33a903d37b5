#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "fathom/geometry/frames.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/ratio.h"

namespace fathom {

/// Where points and directions are.
enum class PointFrame { world, camera };
inline constexpr std::array all_point_frames{PointFrame::world, PointFrame::camera};
/// "world" or "camera".
constexpr std::string_view name_of(PointFrame frame) {
  return frame == PointFrame::world ? "world" : "camera";
}

/// Where a camera stands, or another affine map of points: [R | t], 3×4; R need not be a rotation.
/// Every number is the real number that it denotes.
using Pose = std::array<std::array<double, 4>, 3>;

/// det R, exactly.
Dyadic determinant_of_rotation(const Pose& pose);

/// R·X + t, exactly; scene units.
CameraPoint to_camera(const Pose& world_to_camera, const WorldPoint& X);

/// Camera to world, [R⁻¹ | −R⁻¹·t]: each entry is the exact one, rounded to nearest once.
/// Fails    InputError if R is singular.
Pose camera_to_world(const Pose& world_to_camera);

}  // namespace fathom

/// Poses whose entries are rounded once. Only for .cpp files of this module and of scene/.
namespace fathom::camera {

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// A pose whose entries are exact.
using ExactPose = std::array<std::array<Ratio, 4>, 3>;

/// `v` scaled to length 1, each entry the exact one rounded to nearest. v must not be zero.
std::array<double, 3> unit_vector(const ExactVector3& v);

/// The rotation of a Hamilton quaternion (w, x, y, z) of any length but 0, each entry the exact one
/// rounded once.
Matrix3 rotation_of(const std::array<double, 4>& quaternion);

/// World to camera, [R⁻¹ | −R⁻¹·eye], of a camera at `eye` whose axes in the world are the columns
/// of that rotation R: each entry the exact one rounded once.
Pose view_from(const ExactVector3& eye, const std::array<double, 4>& quaternion);
/// The same, exactly.
ExactPose exact_view_from(const ExactVector3& eye, const std::array<double, 4>& quaternion);

/// World to camera of a camera at `eye` whose axes in the world, right, up and backward as OpenGL
/// has them, are along these vectors of any length: each entry the exact one rounded once. Nothing
/// if the vectors are linearly dependent.
std::optional<Pose> view_along(const std::array<ExactVector3, 3>& axes, const ExactVector3& eye);

/// R·X, exactly.
ExactVector3 rotate(const Matrix3& R, const ExactVector3& X);

/// [R | target − R·X]: the pose that takes the world point X to the camera point `target`; its
/// translation is the exact one rounded once.
Pose pose_that_takes(const Matrix3& R, const ExactVector3& X, const ExactVector3& target);

/// Of a pose [A | b], exactly: the rows of adj A = det A·A⁻¹; det A; and b.
struct Adjugate {
  std::array<ExactVector3, 3> rows;
  Dyadic determinant;
  ExactVector3 translation;
};
Adjugate adjugate(const Pose& pose);

ExactPose exact_pose(const Pose& pose);
/// Each entry rounded once.
Pose rounded_pose(const ExactPose& pose);
/// The pose `second` after the pose `first`, exactly.
ExactPose composed(const ExactPose& second, const ExactPose& first);
/// [A⁻¹ | −A⁻¹·b] of a pose [A | b], exactly; nothing if A is singular.
std::optional<ExactPose> exact_inverse(const Pose& pose);
/// The same, each entry rounded once.
std::optional<Pose> inverse(const Pose& pose);

}  // namespace fathom::camera
