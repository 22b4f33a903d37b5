#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fathom/numeric/interval.h"

/// Arithmetic of intervals, every result rounded outwards by one step of binary64: what IEEE 754
/// rounds to nearest lies within that. Infinite ends say that nothing is known on that side.
namespace fathom::validation {

inline Interval outwards(double lower, double upper) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (std::isnan(lower) || std::isnan(upper)) return {-infinity, infinity};
  return {std::nextafter(lower, -infinity), std::nextafter(upper, infinity)};
}

inline Interval exactly(double x) {
  return {x, x};
}
inline Interval around(double x, double error) {
  return outwards(x - error, x + error);
}
inline Interval widened(const Interval& a, double error) {
  return outwards(a.lower - error, a.upper + error);
}

inline double magnitude(const Interval& a) {
  return std::max(std::abs(a.lower), std::abs(a.upper));
}

inline Interval operator+(const Interval& a, const Interval& b) {
  return outwards(a.lower + b.lower, a.upper + b.upper);
}
inline Interval operator-(const Interval& a) {
  return {-a.upper, -a.lower};
}
inline Interval operator-(const Interval& a, const Interval& b) {
  return a + -b;
}
inline Interval operator*(const Interval& a, const Interval& b) {
  const std::array<double, 4> p{a.lower * b.lower, a.lower * b.upper, a.upper * b.lower,
                                a.upper * b.upper};
  for (const double x : p)
    if (std::isnan(x)) return outwards(x, x);
  return outwards(*std::min_element(p.begin(), p.end()), *std::max_element(p.begin(), p.end()));
}
/// Everything if the divisor may be 0.
inline Interval operator/(const Interval& a, const Interval& b) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  if (!(b.lower > 0 || b.upper < 0)) return outwards(nothing, nothing);
  return a * outwards(1 / b.upper, 1 / b.lower);
}
inline Interval square(const Interval& a) {
  const double greatest = magnitude(a) * magnitude(a);
  const double least = a.lower > 0 ? a.lower * a.lower : a.upper < 0 ? a.upper * a.upper : 0;
  const Interval result = outwards(least, greatest);
  return {std::max(0.0, result.lower), result.upper};
}
/// Of what is not negative.
inline Interval root(const Interval& a) {
  const Interval result = outwards(std::sqrt(std::max(0.0, a.lower)), std::sqrt(a.upper));
  return {std::max(0.0, result.lower), result.upper};
}
inline Interval clamped(const Interval& a, double least, double greatest) {
  return {std::clamp(a.lower, least, greatest), std::clamp(a.upper, least, greatest)};
}

using Range3 = std::array<Interval, 3>;

inline Interval dot(const Range3& a, const Range3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Range3 cross(const Range3& a, const Range3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Range3 operator-(const Range3& a) {
  return {-a[0], -a[1], -a[2]};
}
inline Range3 operator-(const Range3& a, const Range3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Interval length(const Range3& a) {
  return root(square(a[0]) + square(a[1]) + square(a[2]));
}
/// Components stay within [−1, 1], whatever is known of the length.
inline Range3 direction(const Range3& a) {
  const Interval l = length(a);
  return {clamped(a[0] / l, -1, 1), clamped(a[1] / l, -1, 1), clamped(a[2] / l, -1, 1)};
}

}  // namespace fathom::validation
