#pragma once

#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/real.h"

/// Sines, cosines, cotangents, π and logarithms, as numbers that round correctly (real.h).
namespace fathom {

// Of binary64 angles. The sine and the cosine of a rational number of degrees are rational only if
// they are 0, ±½ or ±1, the tangent only if it is 0 or ±1 (Niven, [Niv56]). The tangent of a
// rational number of radians other than 0 is irrational (Lambert).

/// For 0 ≤ degrees ≤ 45. Throws std::domain_error otherwise.
Real sine_of_degrees(double degrees);
Real cosine_of_degrees(double degrees);

/// 1/tan(½·angle), for an angle between 0 and 180 degrees. Throws std::domain_error otherwise.
Real cotangent_of_half_degrees(double angle);
/// The same for an angle between 0 and π radians.
Real cotangent_of_half_radians(double angle);

/// π and 1/π. Both are irrational (Lambert).
Real pi();
Real reciprocal_of_pi();

/// The product of two such sines or cosines, rounded to binary64 once.
double round_product_to_binary64(const Real& a, const Real& b);

/// Sines and cosines of binary64 angles in radians, each the multiple of 2^−bits nearest to the
/// true number. The sine and the cosine of a rational number other than 0 are transcendental
/// (Lindemann), so that none lies halfway between two multiples.
Dyadic sine_on_grid(double radians, long bits);
Dyadic cosine_on_grid(double radians, long bits);

// Logarithms and powers of exact numbers. A rational number greater than 1 is in exactly one way a
// power r^k of a rational r that is itself no such power: k is the greatest common divisor of the
// exponents of its prime factors. So
//   log a / log b is rational  ⇔  a and b are powers of one rational r: a = r^i, b = r^j, i / j;
//   b^(u/v), u/v in lowest terms, is rational  ⇔  b is a v-th power.

/// log a / log b, for a ≥ 1 and b > 1. Throws std::domain_error otherwise.
Real quotient_of_logarithms(const Ratio& a, const Ratio& b);

/// log a, for a ≥ 1: irrational except for a = 1 (Lindemann). Throws std::domain_error otherwise.
Real natural_logarithm(const Ratio& a);

/// b^e − 1, for b > 1 and e ≥ 0. Throws std::domain_error otherwise.
Real power_minus_one(const Ratio& b, const Ratio& e);

}  // namespace fathom
