#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fathom/geometry/frames.h"

namespace fathom {

/// Where the rays of the image come from: the eye, or a plane of parallel rays.
enum class ProjectionModel { perspective, orthographic };
/// "perspective" or "orthographic".
std::string_view name_of(ProjectionModel model);

/// How a camera point becomes an image point, as the specification (section 2) defines it: half of
/// a camera. Where the camera stands is the other half (pose.h). Every number is the real number
/// that it denotes.
///
/// Frame    camera: x right, y down, z forward; image: u right, v down.
/// Unit     cx and cy in pixels; fx, fy and skew in pixels (perspective) or pixels per scene unit
///          (orthographic).
struct Projection {
  ProjectionModel model = ProjectionModel::perspective;
  double fx = 1, fy = 1, cx = 0, cy = 0, skew = 0;
  /// The image coordinate of the top left pixel's centre, as cx and cy count: ½ (COLMAP, OpenGL) or
  /// 0 (OpenCV).
  double pixel_centre = 0.5;

  friend bool operator==(const Projection&, const Projection&) = default;
};

[[nodiscard]] constexpr bool is_perspective(const Projection& projection) {
  return projection.model == ProjectionModel::perspective;
}
[[nodiscard]] constexpr bool is_orthographic(const Projection& projection) {
  return projection.model == ProjectionModel::orthographic;
}

/// Whether the image is mirrored: whether fx and fy differ in sign.
[[nodiscard]] constexpr bool is_mirrored(const Projection& projection) {
  return (projection.fx < 0) != (projection.fy < 0);
}

/// What is wrong with a projection, in one line, or nothing if all numbers are finite, and fx and
/// fy ≠ 0.
std::optional<std::string> find_fault(const Projection& projection);

/// The homogeneous image point of a camera point in pixels, exactly; accounts for `pixel_centre`.
HomogeneousImagePoint to_image(const Projection& projection, const CameraPoint& p);

/// The image of a camera's z axis: pixels from the top left corner of the image, y downwards.
struct PrincipalPoint {
  double x = 0, y = 0;
};

/// The principal point; accounts for `pixel_centre`.
/// Exact    each number is the exact one rounded once. Exact computations use to_image() instead.
PrincipalPoint principal_point(const Projection& projection);

/// The principal point, exactly.
struct ExactPrincipalPoint {
  Dyadic x, y;
};
ExactPrincipalPoint exact_principal_point(const Projection& projection);

}  // namespace fathom
