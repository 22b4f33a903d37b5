#pragma once

#include <optional>

#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/interval.h"

/// Arithmetic of binary64 numbers with bounds that count every rounding of their own, so that many
/// operations may follow each other; a divisor may err by almost all of itself. sum(), product()
/// and quotient() of certified_value.h serve double-words too.
namespace fathom {

/// More than at most 6 roundings of a bound's own terms, none of them negative, can take from it.
inline constexpr double bound_rounding = 1 + 0x1p-48;

Certified<double> operator+(const Certified<double>& a, const Certified<double>& b);
Certified<double> operator*(const Certified<double>& a, const Certified<double>& b);
/// The bound is +∞ if b may be 0.
Certified<double> operator/(const Certified<double>& a, const Certified<double>& b);

/// An interval that contains the exact number; [−∞, ∞] if the bound is +∞ or not known.
Interval enclose(const Certified<double>& x);
/// The exact number rounded to binary32, if the bound settles that. For a number that is not
/// negative, the result is not negative either.
std::optional<float> settled_binary32(const Certified<double>& not_negative);

}  // namespace fathom
