#pragma once

#include <array>

#include "fathom/lens/plane_direction.h"
#include "fathom/lens/root_direction.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/exact_polynomial.h"

namespace fathom::lens {

/// The direction of OMNI with distortion: the formula with a root (RootFormula) at the preimage m
/// under the stage, in the place of a sample.
///
/// Exact    a form at the direction is p + q·√s with polynomials p, q and s in m, s > 0. Where the
///          signs of p and q differ, the sign of p² − q²·s decides. All three are signs of
///          polynomials at a PolynomialDirection.
class BentRootDirection {
 public:
  BentRootDirection(PolynomialDirection m, const RootFormula<Dyadic>& formula);

  [[nodiscard]] Sign sign_of(const ExactVector3& form) const;
  [[nodiscard]] Sign sign_of(const QuadraticForm& form) const;
  /// Encloses the components of d, with a precision of about `bits` relative to d, of x and y
  /// relative to the greater of them.
  [[nodiscard]] std::array<DyadicInterval, 3> enclosure(long bits) const;
  /// Binary64 intervals that contain d.
  [[nodiscard]] const std::array<Interval, 3>& box() const { return box_; }

 private:
  template <class Form>
  [[nodiscard]] Sign sign_of_form(const Form& form) const;

  PolynomialDirection m_;
  RootFormula<Dyadic> formula_;
  std::array<Interval, 3> box_;
};

}  // namespace fathom::lens
