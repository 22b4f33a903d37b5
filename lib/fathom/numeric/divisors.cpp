#include "fathom/numeric/divisors.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "fathom/numeric/integer.h"

namespace fathom {

long last_bit(double x) {
  if (x == 0) return bit_of_zero;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const long biased = static_cast<long>(bits >> 52 & 0x7FF);
  const std::uint64_t significand = (bits & 0xFFFFFFFFFFFFF) | std::uint64_t{biased != 0} << 52;
  return std::max(biased, 1L) - 1075 + std::countr_zero(significand);
}

long last_bit(const Dyadic& x) {
  if (x.is_zero()) return bit_of_zero;
  return static_cast<long>(mpz_scan1(x.significand(), 0)) + x.exponent();
}

ExactVector3 without_common_factor(const ExactVector3& v) {
  long unit = std::numeric_limits<long>::max();
  for (const Dyadic& x : v) {
    if (!x.is_zero()) unit = std::min(unit, x.exponent());
  }
  std::array<Integer, 3> magnitudes;
  Integer divisor;
  for (std::size_t k = 0; k < 3; ++k) {
    if (v[k].is_zero()) continue;
    mpz_abs(magnitudes[k], v[k].significand());
    mpz_mul_2exp(magnitudes[k], magnitudes[k], static_cast<mp_bitcnt_t>(v[k].exponent() - unit));
    mpz_gcd(divisor, divisor, magnitudes[k]);
  }
  ExactVector3 result;
  for (std::size_t k = 0; k < 3; ++k) {
    if (v[k].is_zero()) continue;
    mpz_divexact(magnitudes[k], magnitudes[k], divisor);
    result[k] = Dyadic::of(magnitudes[k]);
    if (v[k].sign() == Sign::negative) result[k] = -result[k];
  }
  return result;
}

}  // namespace fathom
