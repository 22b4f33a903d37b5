#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fathom/numeric/double_word.h"
#include "fathom/numeric/interval.h"

/// Numbers in binary64 or double-words with bounds on their errors, and arithmetic that computes
/// the bounds of its results.
namespace fathom {

/// Relative slack of every bound, for terms of second order and for roundings in the bound.
inline constexpr double slack = 1 + 0x1p-15;

/// More than a value or a bound can lose by underflow: an operation here is fewer than 2⁶
/// operations of IEEE 754, and each loses at most 2⁻¹⁰⁷⁴ in addition to its relative error.
inline constexpr double most_underflow = 0x1p-1000;

/// How much of itself a divisor may err by.
inline constexpr double quotient_condition = 0x1p-20;

/// A number and a bound on its error: |value − exact| ≤ error. An error of 0 means that the value
/// is exact, even if bounds underflow: the error of a product or quotient is at least
/// `most_underflow`, unless a factor or the numerator is exactly 0.
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

/// Arithmetic of binary64 numbers with bounds that count every rounding of their own, so that many
/// operations may follow each other; a divisor may err by almost all of itself. sum(), product()
/// and quotient() above serve double-words too.

/// Compensates for the at most 6 roundings of a bound's own, non-negative terms.
inline constexpr double bound_rounding = 1 + 0x1p-48;

Certified<double> operator+(const Certified<double>& a, const Certified<double>& b);
Certified<double> operator*(const Certified<double>& a, const Certified<double>& b);
/// The bound is +∞ if b may be 0.
Certified<double> operator/(const Certified<double>& a, const Certified<double>& b);
/// The bound is +∞ if x may be 0 or less.
Certified<double> sqrt(const Certified<double>& x);

/// An interval that contains the exact number; [−∞, ∞] if the bound is +∞ or not known.
Interval enclose(const Certified<double>& x);
/// The exact number rounded to binary32, if the bound settles that. For a number that is not
/// negative, the result is not negative either.
std::optional<float> settled_binary32(const Certified<double>& not_negative);

/// For formulas that begin with an interval and end with a sign.

inline Certified<double> operator-(const Certified<double>& x) {
  return {-x.value, x.error};
}

inline Certified<double> operator-(const Certified<double>& a, const Certified<double>& b) {
  return a + -b;
}

/// A number in the interval; the bound is +∞ where an end is infinite or not known.
inline Certified<double> to_certified(const Interval& x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  // Half of a subnormal number may be rounded.
  if (x.lower == x.upper && std::isfinite(x.lower)) return {x.lower, 0};
  const double middle = x.lower / 2 + x.upper / 2;
  const double error = std::max(x.upper - middle, middle - x.lower);
  if (!(error < infinity)) return {0, infinity};
  return {middle, std::nextafter(error, infinity)};
}

/// The sign, if the bound settles it; otherwise Sign::zero.
inline Sign certain_sign(const Certified<double>& x) {
  if (!(std::abs(x.value) > x.error)) return Sign::zero;
  return x.value > 0 ? Sign::positive : Sign::negative;
}

/// A number that a table holds, for arithmetic.
template <bool fused>
Certified<DoubleWord<fused>> in_words(const Certified<WordPair>& x) {
  return {x.value, x.error};
}

/// The operators of double-words with bounds, for formulas over any arithmetic.
template <bool fused>
Certified<DoubleWord<fused>> operator-(const Certified<DoubleWord<fused>>& x) {
  return {-x.value, x.error};
}
template <bool fused>
Certified<DoubleWord<fused>> operator+(const Certified<DoubleWord<fused>>& x,
                                       const Certified<DoubleWord<fused>>& y) {
  return sum(x, y);
}
template <bool fused>
Certified<DoubleWord<fused>> operator-(const Certified<DoubleWord<fused>>& x,
                                       const Certified<DoubleWord<fused>>& y) {
  return sum(x, -y);
}
template <bool fused>
Certified<DoubleWord<fused>> operator*(const Certified<DoubleWord<fused>>& x,
                                       const Certified<DoubleWord<fused>>& y) {
  return product(x, y);
}
template <bool fused>
Certified<DoubleWord<fused>> operator/(const Certified<DoubleWord<fused>>& x,
                                       const Certified<DoubleWord<fused>>& y) {
  return quotient(x, y);
}
/// |√X − √x| = |X − x|/(√X + √x) ≤ error of x/√x. Not known if x may be 0 or less.
template <bool fused>
Certified<DoubleWord<fused>> sqrt(const Certified<DoubleWord<fused>>& x) {
  if (!(x.value.hi > 0 && x.error <= x.value.hi * quotient_condition)) return {};
  const DoubleWord<fused> root = square_root(x.value);
  const double of_operand = (x.error + most_underflow) / root.hi;
  return {root, (of_operand + root_error * root.hi) * slack};
}

}  // namespace fathom
