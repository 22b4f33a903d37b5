#pragma once

#include "fathom/camera/projection.h"
#include "fathom/numeric/certified.h"

namespace fathom::lens {

/// The point (a/c, b/c) of a plane, c > 0, over any arithmetic.
template <class T>
struct HomogeneousPoint {
  T a, b, c;

  /// The same point in another arithmetic.
  template <class Convert>
  [[nodiscard]] auto in(const Convert& convert) const {
    return HomogeneousPoint<decltype(convert(a))>{convert(a), convert(b), convert(c)};
  }
};

/// A point of the plane in which lenses distort: (x_d, y_d) = K⁻¹·(u, v), of a sample (u, v) of the
/// image, exactly.
using DistortedPoint = HomogeneousPoint<Dyadic>;

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
