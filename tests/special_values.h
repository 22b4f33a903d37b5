// Values of binary64 that many tests give and expect.
#pragma once

#include <limits>

namespace fathom {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace fathom
