#pragma once

#include "fathom/camera/projection.h"
#include "fathom/numeric/certified.h"

namespace fathom::lens {

/// The plane in which lenses distort: (x_d, y_d) = K⁻¹·(u, v), of a sample (u, v) of the image.
///
/// Exact    (x_d, y_d) = (a/c, b/c) with dyadic a, b and c > 0.
struct DistortedPoint {
  Dyadic a, b, c;
};

/// K⁻¹, for the samples of one camera.
class SamplePlane {
 public:
  /// Of a valid projection; its model is not used.
  explicit SamplePlane(const Projection& projection);
  /// u, v in pixels from the top left corner of the image, as in the specification: the centre of
  /// the top left pixel is (½, ½) whatever the camera's pixel_centre is.
  [[nodiscard]] DistortedPoint at(const Dyadic& u, const Dyadic& v) const;

 private:
  ExactPrincipalPoint centre_;
  Dyadic fx_, fy_, skew_;
  /// fx·fy.
  Dyadic c_;
};

}  // namespace fathom::lens
