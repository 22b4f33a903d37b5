#pragma once

#include <array>
#include <optional>

#include "fathom/camera/lens.h"
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

/// The tilt of OPENCV_14: the sensor is turned against the lens (specification, section 2).
///
/// Exact    sines and cosines are the multiples of 2⁻¹²⁸ nearest to the true ones; all that is
///          made of them is exact.
class Tilt {
 public:
  /// Of angles less than π/2.
  Tilt(double tau_x, double tau_y);
  /// The tilt of a lens; nullopt if there is none.
  static std::optional<Tilt> of(const Lens& lens);

  /// M, by rows: (x', y', 1) becomes a positive multiple of (x_d, y_d, 1).
  [[nodiscard]] const std::array<ExactVector3, 3>& matrix() const { return matrix_; }
  /// The point before the tilt; nullopt if the third component of M⁻¹·(x_d, y_d, 1) is not
  /// positive.
  [[nodiscard]] std::optional<DistortedPoint> undone(const DistortedPoint& point) const;
  /// A positive multiple of M⁻¹·point.
  [[nodiscard]] ExactVector3 inverse_times(const ExactVector3& point) const;

 private:
  std::array<ExactVector3, 3> matrix_, adjugate_;
};

}  // namespace fathom::lens
