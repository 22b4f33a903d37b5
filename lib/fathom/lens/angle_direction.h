#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "fathom/lens/plane_direction.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/exact_polynomial.h"

namespace fathom::lens {

/// An interval that contains tan(ω/2)/(ω/2), of FOV; 0 ≤ ω < π.
Interval stretch_of_field(double omega);

/// What the angle of a ray is made of, beside |m|.
struct AngleFormula {
  /// Of FOV.
  std::optional<double> omega{};
  /// Of FTHETA; empty otherwise.
  std::vector<Dyadic> polynomial{};
};

/// The direction of a ray whose angle θ to the z axis follows from a point m of the plane:
///   fisheyes  d = (m·sin θ/θ, cos θ) with θ = |m| < π, of unit length
///   FOV       d = (m·sin θ/θ, t·cos θ) with θ = ω|m| < π/2 and t = tan(ω/2)/(ω/2), 0 < ω < π
///   FTHETA    d = (m·sin θ/|m|, cos θ) with 0 < θ = Σ pᵢ·|m|ⁱ < π, of unit length
///
/// Exact    a linear form at d is (l_x·m_x + l_y·m_y)·sin θ/θ + l_z·t·cos θ (t = 1 of fisheyes); a
///          quadratic form is a polynomial of degree 2 in sin θ/θ and t·cos θ. Both are 0 only if
///          all their coefficients are. The coefficients are forms at (m, 1), whose signs are
///          known. All other signs are found in intervals of more and more bits.
///            Of fisheyes and FTHETA, m and θ ≠ 0 are algebraic: tan θ is transcendental
///          (Lindemann).
///            Of FOV, r = |m| is algebraic and ω rational. A linear form has the sign of
///          (a + l_z)·sin ω(r + ½) + (a − l_z)·sin ω(r − ½) with a = (l_x·m_x + l_y·m_y)/2r. The
///          exponents ±iω(r ± ½) are algebraic, and differ because r is neither 0 nor ½: a + l_z
///          and a − l_z have to be 0 (Lindemann, Weierstrass). A quadratic form
///          P·sin² ωr + M·tan(ω/2)·sin ωr·cos ωr + R·tan²(ω/2)·cos² ωr, times 4·cos²(ω/2), is
///            P + R + (R − P)·(cos 2ωr − cos ω)
///            − (P + R + M)/2·cos ω(2r + 1) − (P + R − M)/2·cos ω(2r − 1).
///          No other frequency is 0 or 2r + 1: P + R = 0 and M = 0. This leaves the second term, in
///          which 2r is not 1: R − P = 0.
class AngleDirection {
 public:
  /// Of a fisheye. Needs    0 < |m| < π.
  explicit AngleDirection(PlaneDirection m);
  /// Of FOV.
  /// Needs    0 < ω < π, and a rational m with 0 < ω|m| < π/2 and |m| ≠ ½.
  AngleDirection(RationalDirection m, double omega);
  /// Of FTHETA, with its coefficients p.
  /// Needs    a rational m ≠ 0 with 0 < θ < π.
  AngleDirection(RationalDirection m, std::span<const Dyadic> polynomial);

  [[nodiscard]] Sign sign_of(const ExactVector3& form) const;
  [[nodiscard]] Sign sign_of(const QuadraticForm& form) const;
  /// Encloses the components of d, with a precision of about `bits` relative to d, of x and y
  /// relative to the greater of them.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;
  /// Binary64 intervals that contain d.
  [[nodiscard]] const std::array<Interval, 3>& box() const { return box_; }

 private:
  /// Sign::zero if so many bits do not settle it.
  template <class Form>
  [[nodiscard]] Sign sign_in_bits(const Form& form, long bits) const;
  template <class Form>
  [[nodiscard]] Sign sign_of_nonzero(const Form& form, long bits) const;

  PlaneDirection m_;
  AngleFormula formula_;
  std::array<Interval, 3> box_;
};

}  // namespace fathom::lens
