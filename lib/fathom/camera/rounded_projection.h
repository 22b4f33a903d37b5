#pragma once

#include <array>

#include "fathom/camera/projection.h"

namespace fathom {

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
