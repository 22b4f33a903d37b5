#include "fathom/attribution/ray/camera_rays.h"

#include <Eigen/LU>

#include "fathom/attribution/ray/vector3.h"

namespace fathom::attribution {
CameraRays camera_rays(const Camera& camera) {
  const auto camera_from_world = as_matrix(camera.world_to_camera);
  const Eigen::Matrix3d rotation = camera_from_world.leftCols<3>();
  const Eigen::Matrix3d world_from_camera = rotation.inverse();
  const auto [cx, cy] = principal_point(camera);

  // y = (v − cy)/fy, x = (u − cx − skew·y)/fx on the plane z = 1 (orthographic: on every plane).
  const double skew = camera.skew / (camera.fx * camera.fy);
  const Vector3 corner(-cx / camera.fx + skew * cy, -cy / camera.fy, 0);
  const Vector3 per_u(1 / camera.fx, 0, 0), per_v(-skew, 1 / camera.fy, 0);
  const bool perspective = camera.projection == Projection::perspective;
  const Vector3 forward(0, 0, 1), origin = -camera_from_world.col(3);

  CameraRays rays;
  rays.origin.at_corner =
      as_array(world_from_camera * (perspective ? origin : Vector3(origin + corner)));
  rays.direction.at_corner =
      as_array(world_from_camera * (perspective ? Vector3(forward + corner) : forward));
  CameraRays::Affine& moving = perspective ? rays.direction : rays.origin;
  moving.per_u = as_array(world_from_camera * per_u);
  moving.per_v = as_array(world_from_camera * per_v);
  return rays;
}

}  // namespace fathom::attribution
