#include "fathom/numeric/divisors.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "fathom/numeric/big_numbers.h"

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

void divide_by_common_factor(std::span<Dyadic> numbers) {
  long unit = std::numeric_limits<long>::max();
  for (const Dyadic& x : numbers)
    if (!x.is_zero()) unit = std::min(unit, x.exponent());
  Integer integer, divisor;
  for (Dyadic& x : numbers) {
    if (x.is_zero()) continue;
    mpz_mul_2exp(integer, x.significand(), static_cast<mp_bitcnt_t>(x.exponent() - unit));
    mpz_gcd(divisor, divisor, integer);
    x = Dyadic::of(integer);
  }
  for (Dyadic& x : numbers) {
    if (x.is_zero()) continue;
    mpz_divexact(integer, x.significand(), divisor);
    x = Dyadic::of(integer);
  }
}

ExactVector3 without_common_factor(ExactVector3 v) {
  divide_by_common_factor(v);
  return v;
}

}  // namespace fathom
