#pragma once

#include "fathom/attribution/model/renderer_camera.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/ray/vector3.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// A ray origin + t·direction, t the depth, and how far the renderer's own may be from it,
/// component by component.
struct Ray {
  Vector3 origin, direction, origin_error, direction_error;
};

/// The rays of a camera as a renderer of the model has them.
///
/// Frame    the world moved so that the model's shift is its origin; samples in pixels from the top
///          left corner of the image.
class ModelRays {
 public:
  ModelRays(const Camera& camera, const RayModel& model, double sample_error);

  [[nodiscard]] Ray through(double x, double y) const;

  /// What the rotation's error makes of a vector: a component is a row, off by at most
  /// rotation_error in each of its entries, times a vector of this length.
  [[nodiscard]] double tilt(const Vector3& v) const;

  /// What it adds to the error of a depth t to compute it from the position of the hit.
  [[nodiscard]] double depth_error(const Ray& ray, double t) const;

  /// In the moved world.
  [[nodiscard]] const Camera& camera() const { return camera_; }

 private:
  Camera camera_;
  double rotation_error_, sample_error_;
  CameraRays rays_;
  Vector3 eye_;
};

}  // namespace fathom::attribution
