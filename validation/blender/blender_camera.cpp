#include "validation/blender/blender_camera.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/geometry/eigen_arrays.h"

namespace fathom::validation {
namespace {

constexpr double sensor_width = 36;

[[noreturn]] void refuse(const std::string& what) {
  throw InputError("blender: cannot express " + what);
}

void require_rotation(const Eigen::Matrix3d& R) {
  const Eigen::Matrix3d off = R * R.transpose() - Eigen::Matrix3d::Identity();
  if (off.cwiseAbs().maxCoeff() > 1e-6) refuse("a camera whose R is no rotation");
}

}  // namespace

BlenderCamera blender_camera(const Camera& camera) {
  if (camera.projection.skew != 0) refuse("a camera with skew");
  if (camera.projection.fx <= 0 || camera.projection.fy <= 0) refuse("a mirrored camera");
  const auto camera_from_world = geometry::as_matrix(camera.world_to_camera);
  const Eigen::Matrix3d R = camera_from_world.leftCols<3>();
  require_rotation(R);
  const double pixel = camera.projection.fx / camera.projection.fy;  // aspect_y / aspect_x
  if (pixel > 2 || pixel < 0.5) refuse("pixels more than twice as wide as high, or the reverse");
  const double width = camera.width, height = camera.height;
  const auto [cx, cy] = principal_point(camera.projection);

  BlenderCamera made;
  made.perspective = is_perspective(camera.projection);
  made.aspect_x = std::max(1.0, 1 / pixel);
  made.aspect_y = std::max(1.0, pixel);
  made.lens = camera.projection.fx * sensor_width / width;
  made.ortho_scale = width / camera.projection.fx;
  made.shift_x = (width / 2 - cx) / width;
  made.shift_y = (cy - height / 2) * pixel / width;

  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> world_from_camera(
      made.world_from_camera.data());
  world_from_camera.setIdentity();
  // Blender's camera has y up and z backward.
  world_from_camera.topLeftCorner<3, 3>() = R.transpose() * Eigen::Vector3d(1, -1, -1).asDiagonal();
  world_from_camera.col(3).head<3>() = -R.transpose() * camera_from_world.col(3);
  return made;
}

}  // namespace fathom::validation
