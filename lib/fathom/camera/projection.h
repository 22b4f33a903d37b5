#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "fathom/camera/lens.h"
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
///          (orthographic). Of a panorama, fx is w, and fy is h or fy (lens.h).
struct Projection {
  ProjectionModel model = ProjectionModel::perspective;
  double fx = 1, fy = 1, cx = 0, cy = 0, skew = 0;
  /// The image coordinate of the top left pixel's centre, as cx and cy count: ½ (COLMAP, OpenGL) or
  /// 0 (OpenCV).
  double pixel_centre = 0.5;
  /// Perspective cameras only: how the lens bends rays. The camera is a pinhole without a lens, and
  /// with a lens that bends no ray and has no end.
  std::optional<Lens> lens;

  friend bool operator==(const Projection&, const Projection&) = default;
};

[[nodiscard]] constexpr bool is_perspective(const Projection& projection) {
  return projection.model == ProjectionModel::perspective;
}
[[nodiscard]] constexpr bool is_orthographic(const Projection& projection) {
  return projection.model == ProjectionModel::orthographic;
}

/// Whether a lens bends the rays of the camera: edges of triangles are then curves in its image.
[[nodiscard]] bool bends_rays(const Projection& projection);
/// Whether near and far bound ray distances rather than planar depths, because the rays need not
/// all go forwards.
[[nodiscard]] bool counts_distance(const Projection& projection);

/// Whether the image is mirrored: whether fx and fy differ in sign.
[[nodiscard]] constexpr bool is_mirrored(const Projection& projection) {
  return (projection.fx < 0) != (projection.fy < 0);
}

/// The fault of a projection, in one line, or nothing if all numbers are finite, fx and fy ≠ 0, and
/// a lens is valid and belongs to a perspective camera. With the model TABLE, fx … skew and
/// pixel_centre must have their default values; a panorama has w > 0, h > 0 and no skew.
std::optional<std::string> find_fault(const Projection& projection);

/// The homogeneous image point of a camera point in pixels, exactly; accounts for `pixel_centre`.
/// Needs    a projection that bends no rays.
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

/// The rows of x and y of a projection matrix like OpenGL's, over the camera frame: x of the clip
/// space is xx·X + xy·Y + x1·W, y is yy·Y + y1·W; W is Z (perspective) or 1.
struct ClipRows {
  double xx = 0, xy = 0, x1 = 0, yy = 0, y1 = 0;
};

/// A projection in binary64, both ways: for estimates, and for models of programs that compute in
/// floating point. Exact computations use to_image().
///
/// Frame    image: pixels from the top left corner, as principal_point().
/// Exact    each operation is rounded to binary64.
class RoundedProjection {
 public:
  explicit RoundedProjection(const Projection& projection)
      : projection_(projection), centre_(principal_point(projection)) {}

  /// The image of the camera point p.
  [[nodiscard]] std::array<double, 2> image_of(const std::array<double, 3>& p) const {
    const auto& [x, y, z] = p;
    const double w = is_perspective(projection_) ? z : 1;
    return {(projection_.fx * x + projection_.skew * y) / w + centre_.x,
            projection_.fy * y / w + centre_.y};
  }
  /// The point (x, y) of the plane at depth 1 whose image is (u, v).
  [[nodiscard]] std::array<double, 2> plane_point_at(double u, double v) const {
    const double y = (v - centre_.y) / projection_.fy;
    return {(u - centre_.x - projection_.skew * y) / projection_.fx, y};
  }
  /// With x = 2u/width − 1, y = 1 − 2v/height.
  [[nodiscard]] ClipRows clip_rows(double width, double height) const {
    return {.xx = 2 * projection_.fx / width,
            .xy = 2 * projection_.skew / width,
            .x1 = 2 * centre_.x / width - 1,
            .yy = -2 * projection_.fy / height,
            .y1 = 1 - 2 * centre_.y / height};
  }

 private:
  Projection projection_;
  PrincipalPoint centre_;
};

}  // namespace fathom
