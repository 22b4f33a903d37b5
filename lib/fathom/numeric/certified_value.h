#pragma once

#include <cmath>
#include <limits>

#include "fathom/numeric/double_word.h"

/// Numbers in binary64 or double-words with bounds on their errors, and what arithmetic makes of
/// the bounds.
namespace fathom {

/// Relative slack of every bound, for terms of second order and for roundings in the bound.
inline constexpr double slack = 1 + 0x1p-15;

/// More than underflow can take from a value or a bound: an operation here is fewer than 2⁶ of
/// IEEE 754, each of which loses at most 2⁻¹⁰⁷⁴ beside its relative error.
inline constexpr double most_underflow = 0x1p-1000;

/// How much of itself a divisor may err by.
inline constexpr double quotient_condition = 0x1p-20;

/// A number and a bound on its error: |value − exact| ≤ error. An error of 0 says that the value is
/// exact, also where bounds underflow: products and quotients have at least that of
/// `most_underflow`, except of a factor or numerator that is exactly 0.
template <class Real>
struct Certified {
  Real value{};
  double error = std::numeric_limits<double>::infinity();
};

template <class Real>
bool is_exact_zero(const Certified<Real>& x) {
  return nearest(x.value) == 0 && x.error == 0;
}

/// Where ε|x + y| underflows, the sum is exact: it is a multiple of 2⁻¹⁰⁷⁴, and all multiples of
/// that below 2⁻¹⁰²¹ (double-words: 2⁻⁹⁶⁸) are representable.
template <class Real>
Certified<Real> sum(const Certified<Real>& x, const Certified<Real>& y) {
  const Real value = x.value + y.value;
  return {value, (x.error + y.error + epsilon<Real> * std::abs(nearest(value))) * slack};
}

template <class Real>
Certified<Real> product(const Certified<Real>& x, const Certified<Real>& y) {
  if (is_exact_zero(x) || is_exact_zero(y)) return {Real(0.0), 0};
  const Real value = x.value * y.value;
  const double x_size = std::abs(nearest(x.value)), y_size = std::abs(nearest(y.value));
  const double error = x_size * y.error + (y_size + y.error) * x.error;
  return {value, (error + epsilon<Real> * std::abs(nearest(value)) + most_underflow) * slack};
}

/// The quotient x/y. With X, Y the exact numbers,
///   |x/y − X/Y| = |(x − X) + (X/Y)·(Y − y)| / |y| ≤ (E_x + (|x/y| + |x/y − X/Y|)·E_y) / |y|,
/// so if E_y ≤ 2⁻²⁰|y| at most (E_x + |x/y|·E_y)/|y|·(1 + 2⁻¹⁹). The division adds ε. Its remainder
/// x − (x/y)·y may underflow before it is divided by y. Not known if y may be 0.
template <class Real>
Certified<Real> quotient(const Certified<Real>& x, const Certified<Real>& y) {
  const double size = std::abs(nearest(y.value));
  if (!(size > 0 && y.error <= size * quotient_condition)) return {};
  if (is_exact_zero(x)) return {Real(0.0), 0};
  const Real value = x.value / y.value;
  const double magnitude = std::abs(nearest(value));
  const double of_operands = (x.error + magnitude * y.error + most_underflow) / size;
  return {value, (of_operands + epsilon<Real> * magnitude + most_underflow) * slack};
}

}  // namespace fathom
