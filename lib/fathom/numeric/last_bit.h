#pragma once

#include "fathom/numeric/dyadic.h"

namespace fathom {

/// n such that the number is a multiple of 2ⁿ, but not of 2ⁿ⁺¹; zero, a multiple of all, has
/// bit_of_zero, which is beyond every other.
inline constexpr long bit_of_zero = 1L << 40;
long last_bit(double x);
long last_bit(const Dyadic& x);

}  // namespace fathom
