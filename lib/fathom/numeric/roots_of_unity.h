#pragma once

#include <vector>

#include "fathom/numeric/dyadic.h"

/// Sums of cosines of rational parts of a turn, and whether such a sum is 0.
namespace fathom {

/// amplitude·cos(2π·part/turn); the turn is the same for all waves of a sum.
struct Wave {
  Dyadic amplitude;
  Dyadic part;
};
using Waves = std::vector<Wave>;

/// The rest of `part` after whole turns: 0 ≤ rest < turn.
/// Needs    turn > 0.
Dyadic without_whole_turns(const Dyadic& part, const Dyadic& turn);

/// The product of two sums: a product of cosines is half the sum of two others.
Waves product(const Waves& a, const Waves& b);
Waves operator*(const Dyadic& factor, Waves waves);
Waves& operator+=(Waves& a, const Waves& b);

/// Whether the sum of the waves is 0.
///
/// Exact    the sum is one of k roots of unity with rational coefficients. Where such a sum
///          vanishes and no part of it does, the quotients of its roots are m-th roots of unity, m
///          the product of the primes up to k (Mann). So the roots whose quotients are m-th roots
///          of unity are put together, and each such part has to vanish. In a part, the largest
///          prime p of m splits the roots by powers of the p-th root of unity; the part vanishes if
///          and only if the factors of the p powers are all equal, which are sums of the same kind
///          for m/p. No number is factorized.
/// Needs    turn > 0; at most 30 different roots ±e^(±2πi·part/turn).
/// Source   H. B. Mann, On linear relations between roots of unity, Mathematika 12 (1965)
bool is_zero(const Waves& waves, const Dyadic& turn);

}  // namespace fathom
