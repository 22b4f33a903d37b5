#pragma once

#include <cmath>
#include <limits>

namespace fathom {

/// The greatest binary32 number that is at most x.
inline float round_down(double x) {
  const auto nearest = static_cast<float>(x);
  return nearest <= x ? nearest : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}
/// The least binary32 number that is at least x.
inline float round_up(double x) {
  return -round_down(-x);
}

}  // namespace fathom
