#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/numeric/unit_roundoff.h"

// What the certificates of places compute with.
namespace fathom::fast::place_arithmetic {

inline constexpr double u = unit_roundoff<double>;
/// Covers the roundings of a few operations on positive numbers.
inline constexpr double up = 1 + 0x1p-40;
/// The place of a sample without a ray.
inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

inline double greatest_size(double a, double b) {
  return std::max(std::abs(a), std::abs(b));
}

}  // namespace fathom::fast::place_arithmetic
