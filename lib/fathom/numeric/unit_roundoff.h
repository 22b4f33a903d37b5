#pragma once

#include <limits>

namespace fathom {

/// Half the distance from 1 to the next number, 2⁻⁵³ of binary64 and 2⁻²⁴ of binary32: the relative
/// error of one rounding to nearest whose result is a normal number.
template <class Real>
inline constexpr double unit_roundoff = static_cast<double>(std::numeric_limits<Real>::epsilon()) /
                                        2;

}  // namespace fathom
