#pragma once

#include "fathom/numeric/real.h"

/// Logarithms and powers of exact numbers, as numbers that round correctly (real.h).
///
/// A rational number greater than 1 is in exactly one way a power r^k of a rational r that is
/// itself no such power: k is the greatest common divisor of the exponents of its prime factors. So
///   log a / log b is rational  ⇔  a and b are powers of one rational r: a = r^i, b = r^j, i / j;
///   b^(u/v), u/v in lowest terms, is rational  ⇔  b is a v-th power.
namespace fathom {

/// log a / log b, for a ≥ 1 and b > 1. Throws std::domain_error otherwise.
Real quotient_of_logarithms(const Ratio& a, const Ratio& b);

/// log a, for a ≥ 1: irrational except for a = 1 (Lindemann). Throws std::domain_error otherwise.
Real natural_logarithm(const Ratio& a);

/// b^e − 1, for b > 1 and e ≥ 0. Throws std::domain_error otherwise.
Real power_minus_one(const Ratio& b, const Ratio& e);

}  // namespace fathom
