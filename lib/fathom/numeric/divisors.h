#pragma once

#include <span>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"

namespace fathom {

/// n such that the number is a multiple of 2ⁿ, but not of 2ⁿ⁺¹; for zero, a multiple of all,
/// bit_of_zero, which is beyond every other.
inline constexpr long bit_of_zero = 1L << 40;
long last_bit(double x);
long last_bit(const Dyadic& x);

/// Replaces numbers by the least integers with the same ratios and signs: lists that differ by a
/// positive factor become equal. Zeroes stay zeroes.
/// Exact    always.
void divide_by_common_factor(std::span<Dyadic> numbers);
/// The same of the components of a vector.
ExactVector3 without_common_factor(ExactVector3 v);

}  // namespace fathom
