#pragma once

#include <array>
#include <variant>

#include "fathom/lens/polynomial_direction.h"
#include "fathom/lens/rational_direction.h"

namespace fathom::lens {

/// The direction of a fisheye, whose angle θ to the z axis is |m|: d = (m·sin θ/θ, cos θ), of unit
/// length, 0 < θ < π.
///
/// Exact    m is algebraic and not 0, and so is θ; tan θ is therefore transcendental (Lindemann).
///          A linear form at d, (l_x·m_x + l_y·m_y)·sin θ/θ + l_z·cos θ, is 0 only if both
///          coefficients are. A quadratic form is a polynomial in tan θ, times cos² θ; it is 0 only
///          if its three coefficients are. The coefficients are forms at (m, 1), whose signs are
///          known; all other signs are found in intervals of more and more bits.
class AngleDirection {
 public:
  /// (m, 1), as the stage of the lens has it.
  using PlaneDirection = std::variant<RationalDirection, PolynomialDirection>;

  /// Needs    0 < |m| < π.
  explicit AngleDirection(PlaneDirection m);

  [[nodiscard]] Sign sign_of(const ExactVector3& form) const;
  [[nodiscard]] Sign sign_of(const QuadraticForm& form) const;
  /// Encloses the components of d, with a precision of about `bits` relative to 1, of x and y
  /// relative to the greater of them.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;
  /// Binary64 intervals that contain d.
  [[nodiscard]] const std::array<Interval, 3>& box() const { return box_; }

 private:
  PlaneDirection m_;
  std::array<Interval, 3> box_;
};

}  // namespace fathom::lens
