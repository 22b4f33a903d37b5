#pragma once

#include <optional>

#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/interval.h"

/// Arithmetic of binary64 numbers with bounds that hold whatever underflows: unlike sum(),
/// product() and quotient() of certified_value.h, which are as exact in double-words but count on
/// magnitudes at which nothing does.
namespace fathom {

/// More than what underflow can do to a sum of products of numbers below 1: each of fewer than 2⁶
/// operations loses at most 2⁻¹⁰⁷⁴, and so does each coefficient.
inline constexpr double most_underflow = 0x1p-1000;
/// Above all that at most 6 roundings of a bound's own terms, none negative, can take from it.
inline constexpr double bound_rounding = 1 + 0x1p-48;

Certified<double> operator+(const Certified<double>& a, const Certified<double>& b);
Certified<double> operator*(const Certified<double>& a, const Certified<double>& b);
/// The bound is +∞ where b may be 0.
Certified<double> operator/(const Certified<double>& a, const Certified<double>& b);

/// Contains the exact number; [−∞, ∞] where the bound is +∞ or not known.
Interval enclose(const Certified<double>& x);
/// The exact number rounded to binary32, where the bound settles that. A number that is not
/// negative: then neither is what is returned.
std::optional<float> settled_binary32(const Certified<double>& not_negative);

}  // namespace fathom
