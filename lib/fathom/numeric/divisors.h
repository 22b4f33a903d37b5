#pragma once

#include "fathom/numeric/certified.h"
#include "fathom/numeric/dyadic.h"

namespace fathom {

/// n such that the number is a multiple of 2ⁿ, but not of 2ⁿ⁺¹; for zero, a multiple of all,
/// bit_of_zero, which is beyond every other.
inline constexpr long bit_of_zero = 1L << 40;
long last_bit(double x);
long last_bit(const Dyadic& x);

/// The least integers in the same proportions and with the same signs: of all vectors that differ
/// by a positive factor, the one that stands for them. Zero stays zero.
/// Exact    always.
ExactVector3 without_common_factor(const ExactVector3& v);

}  // namespace fathom
