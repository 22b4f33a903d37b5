#include "fathom/attribution/ray/model_ray.h"

#include <cmath>

#include "fathom/numeric/unit_roundoff.h"

// docs/validation.md, "A ray tracer", derives what stands here.
namespace fathom::attribution {
namespace {

constexpr double u = unit_roundoff<float>;

/// The camera in a world whose origin is `shift`.
Camera moved(Camera camera, const Vector3& shift) {
  auto camera_from_world = as_matrix(camera.world_to_camera);
  camera_from_world.col(3) += camera_from_world.leftCols<3>() * shift;
  return camera;
}

/// −Rᵀt; used where R is a rotation.
Vector3 eye_of(const Camera& camera) {
  const auto camera_from_world = as_matrix(camera.world_to_camera);
  return -camera_from_world.leftCols<3>().transpose() * camera_from_world.col(3);
}

}  // namespace

ModelRays::ModelRays(const Camera& camera, const RayModel& model, double sample_error)
    : camera_(moved(camera, as_vector(model.shift))),
      rotation_error_(model.rotation_error),
      sample_error_(sample_error),
      rays_(camera_rays(camera_)),
      eye_(eye_of(camera_)) {}

double ModelRays::tilt(const Vector3& v) const {
  return rotation_error_ * std::sqrt(3 * v.squaredNorm());
}

/// Each part of a ray is a sum of three terms, two of them products with a rounded factor and a
/// rounded position; a sample that lies elsewhere in the pixel moves it by its derivatives.
Ray ModelRays::through(double x, double y) const {
  Ray ray;
  const auto part = [&](const CameraRays::Affine& f, Vector3& value, Vector3& error) {
    const Vector3 at_corner = as_vector(f.at_corner), per_u = as_vector(f.per_u),
                  per_v = as_vector(f.per_v);
    value = at_corner + x * per_u + y * per_v;
    error = 4 * u * (abs(at_corner) + abs(x * per_u) + abs(y * per_v)) +
            sample_error_ * (abs(per_u) + abs(per_v));
  };
  part(rays_.origin, ray.origin, ray.origin_error);
  part(rays_.direction, ray.direction, ray.direction_error);
  ray.origin_error.array() += tilt(ray.origin - eye_);
  ray.direction_error.array() += tilt(ray.direction);
  return ray;
}

double ModelRays::depth_error(const Ray& ray, double t) const {
  const Eigen::Map<const Eigen::Vector4d> row(camera_.world_to_camera[2].data());
  const Vector3 along = t * ray.direction;
  const double terms = abs(row.head<3>()).dot(abs(ray.origin) + 2 * abs(along)) + std::abs(row.w());
  return 8 * u * terms + tilt(ray.origin + along - eye_);
}

}  // namespace fathom::attribution
