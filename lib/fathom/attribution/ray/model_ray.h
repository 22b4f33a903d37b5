#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"
#include "fathom/geometry/eigen_arrays.h"

/// Vectors of three binary64 numbers. Bounds here hold for any order of summation, which Eigen
/// chooses (docs/validation.md, own_roundings).
namespace fathom::attribution {

using Vector3 = Eigen::Vector3d;

using geometry::as_array;
using geometry::as_matrix;
using geometry::as_vector;

/// Component by component.
inline Vector3 abs(const Vector3& a) {
  return a.cwiseAbs();
}

/// det(a, b, c) with the absolute value of every product: roundings of a determinant are relative
/// to it.
inline double permanent(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 p = abs(a), q = abs(b), r = abs(c);
  return p[0] * (q[1] * r[2] + q[2] * r[1]) + p[1] * (q[2] * r[0] + q[0] * r[2]) +
         p[2] * (q[0] * r[1] + q[1] * r[0]);
}

/// A ray origin + t·direction with bounds on the deviation of the renderer's own ray, component by
/// component.
struct Ray {
  Vector3 origin, direction, origin_error, direction_error;
  /// The depth is t times this; it is 1 for the rays of a camera.
  double length = 1;
};

/// The rays of a camera as a renderer of the model has them.
///
/// Frame    the world moved so that the model's shift is its origin; samples in pixels from the top
///          left corner of the image.
class ModelRays {
 public:
  ModelRays(const Camera& camera, const RayModel& model, double sample_error);

  [[nodiscard]] Ray through(double x, double y) const;

  /// The effect of the rotation's error on a vector: a component is a row, whose entries err by at
  /// most rotation_error each, times a vector of this length.
  [[nodiscard]] double tilt(const Vector3& v) const;

  /// The additional error of a depth t that is computed from the position of the hit.
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
