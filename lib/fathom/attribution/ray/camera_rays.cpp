#include "fathom/attribution/ray/camera_rays.h"

#include "fathom/attribution/ray/vector3.h"

namespace fathom::attribution {
namespace {

/// R⁻¹ of world_to_camera, by cofactors.
class WorldFromCamera {
 public:
  explicit WorldFromCamera(const Camera& camera) {
    const auto row = [&](std::size_t i) {
      const auto& r = camera.world_to_camera[i];
      return Vector3{r[0], r[1], r[2]};
    };
    const Vector3 x = row(0), y = row(1), z = row(2);
    columns_ = {cross(y, z), cross(z, x), cross(x, y)};
    const double determinant = dot(x, columns_[0]);
    for (Vector3& column : columns_) {
      for (double& component : column) component /= determinant;
    }
  }

  [[nodiscard]] Vector3 operator()(const Vector3& p) const {
    Vector3 world{};
    for (std::size_t k = 0; k < 3; ++k) {
      world[k] = columns_[0][k] * p[0] + columns_[1][k] * p[1] + columns_[2][k] * p[2];
    }
    return world;
  }

 private:
  std::array<Vector3, 3> columns_;
};

}  // namespace

CameraRays camera_rays(const Camera& camera) {
  const WorldFromCamera world_from_camera(camera);
  const auto [cx, cy] = principal_point(camera);
  const auto& m = camera.world_to_camera;
  const Vector3 to_world{-m[0][3], -m[1][3], -m[2][3]};  // of the camera point 0

  // y = (v − cy)/fy, x = (u − cx − skew·y)/fx on the plane z = 1 (orthographic: on every plane).
  const double skew = camera.skew / (camera.fx * camera.fy);
  const Vector3 corner{-cx / camera.fx + skew * cy, -cy / camera.fy, 0};
  const CameraRays::Affine lateral{world_from_camera(corner),
                                   world_from_camera({1 / camera.fx, 0, 0}),
                                   world_from_camera({-skew, 1 / camera.fy, 0})};
  CameraRays rays;
  rays.origin.at_corner = world_from_camera(to_world);
  rays.direction.at_corner = world_from_camera({0, 0, 1});
  CameraRays::Affine& moving =
      camera.projection == Projection::perspective ? rays.direction : rays.origin;
  for (std::size_t k = 0; k < 3; ++k) moving.at_corner[k] += lateral.at_corner[k];
  moving.per_u = lateral.per_u;
  moving.per_v = lateral.per_v;
  return rays;
}

}  // namespace fathom::attribution
