#pragma once

#include <array>
#include <optional>

#include "fathom/camera/lens.h"
#include "fathom/lens/sample_plane.h"

namespace fathom::lens {

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
