#include "fathom/camera/pose.h"

#include "fathom/camera/rounded_poses.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {

Dyadic determinant_of_rotation(const Pose& pose) {
  const auto row = [&](int i) { return ExactVector3{pose[i][0], pose[i][1], pose[i][2]}; };
  return determinant(row(0), row(1), row(2));
}

CameraPoint to_camera(const Pose& world_to_camera, const WorldPoint& X) {
  const auto row = [&](int i) {
    const auto& [r0, r1, r2, t] = world_to_camera[i];
    return r0 * X.x + r1 * X.y + r2 * X.z + t;
  };
  return {row(0), row(1), row(2)};
}

Pose camera_to_world(const Pose& world_to_camera) {
  const StandardArithmetic standard;
  const auto inverse = camera::inverse(world_to_camera);
  if (!inverse) throw InputError("the camera cannot be inverted: its matrix is singular");
  return *inverse;
}

}  // namespace fathom
