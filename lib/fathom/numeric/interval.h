#pragma once

#include <cmath>
#include <limits>

/// Intervals whose ends are rounded outwards, and the signs of the numbers in them.
namespace fathom {

/// A closed interval of binary64 numbers that contains an exact value.
///
/// Exact    every function that returns one rounds its ends outwards. An end may be infinite. A NaN
///          at an end means "nothing is known"; every comparison with it is undecided.
struct Interval {
  double lower = 0;
  double upper = 0;
};

/// The sign of an exact number.
enum class Sign : signed char { negative = -1, zero = 0, positive = 1 };

constexpr Sign operator-(Sign s) {
  return static_cast<Sign>(-static_cast<int>(s));
}
constexpr Sign operator*(Sign a, Sign b) {
  return static_cast<Sign>(static_cast<int>(a) * static_cast<int>(b));
}
constexpr Sign sign_of(int value) {
  return static_cast<Sign>((value > 0) - (value < 0));
}

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
