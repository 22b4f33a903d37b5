#include "fathom/numeric/last_bit.h"

#include <algorithm>
#include <bit>
#include <cstdint>

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

}  // namespace fathom
