#pragma once

#include <array>
#include <optional>

#include "fathom/lens/stage.h"

/// Where the symmetric part of a stage's Jacobian is positive definite: exactly on a circle, proved
/// by subdivision on a ring.
namespace fathom::lens {

/// The function constant(q) + linear(q)·m + xx(q)·x² + xy(q)·xy + yy(q)·y² of m = (x, y), q = |m|².
struct PlaneFunction {
  ExactPolynomial constant;
  std::array<ExactPolynomial, 2> linear;
  ExactPolynomial xx, xy, yy;
};

/// With A = L + 2p·m and g = 2p + (s1, s3) + 2q·(s2, s4) the symmetric part is
/// A·I + 2L'·m·mᵀ + m·gᵀ + g·mᵀ. On the axes m/r and perpendicular to it, it is
///   [[A + 2qL' + 2g·m, m × g], [m × g, A]].
/// It is the identity at 0, so it is positive definite on a disc if its determinant is positive
/// there. D³ times the determinant is a polynomial, a PlaneFunction.
class Definiteness {
 public:
  explicit Definiteness(const StageNumbers<ExactPolynomial>& stage);

  /// D; the other functions are about circles and rings where it is positive.
  [[nodiscard]] const ExactPolynomial& denominator() const { return denominator_; }
  /// D²·(r·L)'.
  [[nodiscard]] const ExactPolynomial& radial_slope() const { return radial_slope_; }

  /// A q = 4^j > 0 such that the determinant is positive where |m|² ≤ q; nullopt if such a q is no
  /// binary64 number.
  [[nodiscard]] std::optional<double> inner_bound() const;
  /// The same where |m|² ≥ q. nullopt also if the determinant is negative far outside.
  [[nodiscard]] std::optional<double> outer_bound() const;

  /// Whether the symmetric part is positive definite where |m|² = q. Decided exactly.
  [[nodiscard]] bool holds_on_circle(const Dyadic& q) const;

  enum class Verdict { holds, fails, unknown };
  struct RingVerdict {
    Verdict verdict;
    /// Where it fails: |m|² of a point where the determinant is not positive.
    Dyadic q;
  };
  /// Whether the determinant is positive where inner ≤ |m|² ≤ outer, if it is where |m|² = outer.
  [[nodiscard]] RingVerdict holds_on_ring(double inner, double outer) const;

 private:
  ExactPolynomial numerator_, denominator_, radial_slope_;
  /// D³ times the determinant, and its derivative along m: r·∂/∂r.
  PlaneFunction determinant_, growth_;
};

}  // namespace fathom::lens
