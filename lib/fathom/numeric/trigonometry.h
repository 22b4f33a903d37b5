#pragma once

#include "fathom/numeric/real.h"

/// Sines, cosines and cotangents of binary64 angles, as numbers that round correctly (real.h).
///
/// Of an angle in degrees that is rational, sine and cosine are rational only where they are 0, ±½
/// or ±1, and the tangent where it is 0 or ±1 (Niven). Of an angle in radians that is rational and
/// not 0, the tangent is irrational (Lambert).
/// Source   [Niv56]
namespace fathom {

/// For 0 ≤ degrees ≤ 45. Throws std::domain_error otherwise.
Real sine_of_degrees(double degrees);
Real cosine_of_degrees(double degrees);

/// 1/tan(½·angle), for an angle between 0 and 180 degrees. Throws std::domain_error otherwise.
Real cotangent_of_half_degrees(double angle);
/// The same for an angle between 0 and π radians.
Real cotangent_of_half_radians(double angle);

/// The product of two sines or cosines of above, rounded to binary64 once.
double round_product_to_binary64(const Real& a, const Real& b);

}  // namespace fathom
