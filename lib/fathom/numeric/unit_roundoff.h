#pragma once

#include <limits>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {

/// Half the distance from 1 to the next number, 2⁻⁵³ for binary64 and 2⁻²⁴ for binary32: the
/// relative error of one rounding to nearest whose result is a normal number.
template <class Real>
inline constexpr double unit_roundoff = static_cast<double>(std::numeric_limits<Real>::epsilon()) /
                                        2;

}  // namespace fathom
