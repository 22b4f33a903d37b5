#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/numeric/certified_arithmetic.h"

/// What certified_arithmetic.h lacks for formulas that begin with an interval and end with a sign.
namespace fathom {

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

}  // namespace fathom
