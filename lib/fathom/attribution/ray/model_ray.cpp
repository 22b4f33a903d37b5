#include "fathom/attribution/ray/model_ray.h"

#include "fathom/numeric/unit_roundoff.h"

// docs/validation.md, "A ray tracer", derives what stands here.
namespace fathom::attribution {
namespace {

constexpr double u = unit_roundoff<float>;

/// The camera in a world whose origin is `shift`.
Camera moved(Camera camera, const Vector3& shift) {
  for (auto& row : camera.world_to_camera) {
    row[3] += row[0] * shift[0] + row[1] * shift[1] + row[2] * shift[2];
  }
  return camera;
}

/// −Rᵀt; used where R is a rotation.
Vector3 eye_of(const Camera& camera) {
  Vector3 eye{};
  for (const auto& row : camera.world_to_camera) {
    for (std::size_t k = 0; k < 3; ++k) eye[k] -= row[k] * row[3];
  }
  return eye;
}

}  // namespace

ModelRays::ModelRays(const Camera& camera, const RayModel& model, double sample_error)
    : camera_(moved(camera, model.shift)),
      rotation_error_(model.rotation_error),
      sample_error_(sample_error),
      rays_(camera_rays(camera_)),
      eye_(eye_of(camera_)) {}

double ModelRays::tilt(const Vector3& v) const {
  return rotation_error_ * std::sqrt(3 * dot(v, v));
}

/// Each part of a ray is a sum of three terms, two of them products with a rounded factor and a
/// rounded position; a sample that lies elsewhere in the pixel moves it by its derivatives.
Ray ModelRays::through(double x, double y) const {
  Ray ray;
  const auto part = [&](const CameraRays::Affine& f, Vector3& value, Vector3& error) {
    for (std::size_t k = 0; k < 3; ++k) {
      value[k] = f.at_corner[k] + x * f.per_u[k] + y * f.per_v[k];
      error[k] =
          4 * u * (std::abs(f.at_corner[k]) + std::abs(x * f.per_u[k]) + std::abs(y * f.per_v[k])) +
          sample_error_ * (std::abs(f.per_u[k]) + std::abs(f.per_v[k]));
    }
  };
  part(rays_.origin, ray.origin, ray.origin_error);
  part(rays_.direction, ray.direction, ray.direction_error);
  for (std::size_t k = 0; k < 3; ++k) {
    ray.origin_error[k] += tilt(ray.origin - eye_);
    ray.direction_error[k] += tilt(ray.direction);
  }
  return ray;
}

double ModelRays::depth_error(const Ray& ray, double t) const {
  const auto& m = camera_.world_to_camera[2];
  const Vector3& d = ray.direction;
  double terms = std::abs(m[3]);
  for (std::size_t k = 0; k < 3; ++k) {
    terms += std::abs(m[k]) * (std::abs(ray.origin[k]) + 2 * std::abs(t * d[k]));
  }
  return 8 * u * terms + tilt(ray.origin + t * d - eye_);
}

}  // namespace fathom::attribution
