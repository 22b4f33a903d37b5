#pragma once

#include <array>

#include "fathom/camera/lens.h"
#include "fathom/lens/sample_plane.h"
#include "fathom/numeric/dyadic.h"

namespace fathom::lens {

/// The angle of FTHETA to the z axis, θ = Σ pᵢ·rⁱ, as a function of the distance r of a sample from
/// the axis.
class AnglePolynomial {
 public:
  /// Of a valid lens of the model FTHETA. Takes about a millisecond.
  explicit AnglePolynomial(const Lens& lens);

  [[nodiscard]] const std::array<Dyadic, 6>& coefficients() const { return coefficients_; }
  /// R: the greatest binary64 number such that θ' > 0 and |θ| < π where 0 < r ≤ R. 0 if there is
  /// none.
  [[nodiscard]] double end() const { return end_; }
  /// In binary64.
  [[nodiscard]] double at(double r) const;
  /// The r < end() with this angle, in binary64; end() if there is none.
  [[nodiscard]] double radius_at(double angle) const;
  /// The sign of θ − angle where r = |y| > 0, exactly.
  [[nodiscard]] Sign compare(const DistortedPoint& y, const Dyadic& angle) const;

 private:
  [[nodiscard]] bool is_below_pi(double r) const;

  std::array<Dyadic, 6> coefficients_;
  double end_;
};

}  // namespace fathom::lens
