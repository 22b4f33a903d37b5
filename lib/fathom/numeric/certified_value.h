#pragma once

#include <cmath>
#include <limits>

#include "fathom/numeric/double_word.h"

/// Numbers in binary64 or double-words with bounds on their errors, and what arithmetic makes of
/// the bounds.
namespace fathom {

/// Relative slack of every bound, for terms of second order and for roundings in the bound.
inline constexpr double slack = 1 + 0x1p-15;

/// A number and a bound on its error: |value − exact| ≤ error.
template <class Real>
struct Certified {
  Real value{};
  double error = std::numeric_limits<double>::infinity();
};

template <class Real>
Certified<Real> sum(const Certified<Real>& x, const Certified<Real>& y) {
  const Real value = x.value + y.value;
  return {value, (x.error + y.error + epsilon<Real> * std::abs(nearest(value))) * slack};
}

template <class Real>
Certified<Real> product(const Certified<Real>& x, const Certified<Real>& y) {
  const Real value = x.value * y.value;
  const double x_size = std::abs(nearest(x.value)), y_size = std::abs(nearest(y.value));
  const double error = x_size * y.error + (y_size + y.error) * x.error;
  return {value, (error + epsilon<Real> * std::abs(nearest(value))) * slack};
}

/// The quotient x/y. With X, Y the exact numbers,
///   |x/y − X/Y| = |(x − X) + (X/Y)·(Y − y)| / |y| ≤ (E_x + (|x/y| + |x/y − X/Y|)·E_y) / |y|,
/// so if E_y ≤ 2⁻²⁰|y| at most (E_x + |x/y|·E_y)/|y|·(1 + 2⁻¹⁹). The division adds ε.
template <class Real>
Certified<Real> quotient(const Certified<Real>& x, const Certified<Real>& y) {
  const double size = std::abs(nearest(y.value));
  if (!(y.error <= size * 0x1p-20)) return {};
  const Real value = x.value / y.value;
  const double magnitude = std::abs(nearest(value));
  return {value, ((x.error + magnitude * y.error) / size + epsilon<Real> * magnitude) * slack};
}

}  // namespace fathom
