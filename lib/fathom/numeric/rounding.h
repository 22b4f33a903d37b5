#pragma once

#include <bit>
#include <cstdint>
#include <optional>

#include "fathom/numeric/ratio.h"

/// Correct rounding: the exact number rounded once, to nearest, ties to even (specification,
/// section 6). An exact zero gives +0, a negative number that underflows gives −0, subnormals are
/// kept, overflow gives an infinity.
namespace fathom {

/// The bits of an IEEE 754 binary16 number.
struct Binary16 {
  std::uint16_t bits = 0;
  friend bool operator==(Binary16, Binary16) = default;
};

float round_to_binary32(const Ratio& x);
double round_to_binary64(const Ratio& x);
Binary16 round_to_binary16(const Ratio& x);

/// The binary64 number nearest to x if it is normal, or if x is 0: its error is at most 2⁻⁵³ of x.
/// nullopt if x over- or underflows, because bounds on relative errors do not cover that loss.
std::optional<double> round_to_normal(const Ratio& x);

/// √x rounded once. Throws std::domain_error if x < 0.
float round_sqrt_to_binary32(const Ratio& x);
double round_sqrt_to_binary64(const Ratio& x);

/// The integer nearest to x, ties to even; nullopt if it is negative or above `greatest`.
std::optional<std::uint64_t> round_to_integer(const Ratio& x, std::uint64_t greatest);

/// The integer nearest to √x, ties to even; nullopt if it is above `greatest`.
/// Throws std::domain_error if x < 0.
std::optional<std::uint64_t> round_sqrt_to_integer(const Ratio& x, std::uint64_t greatest);

/// The unorm-n code of x in [0, 1], n ≤ 32: the integer nearest to x·(2ⁿ − 1), ties to even.
/// nullopt if x is outside [0, 1].
std::optional<std::uint32_t> round_to_unorm(const Ratio& x, int bits);

/// The value of a binary16 number as a binary32 number; exact. A NaN keeps its sign and payload.
inline float widen_binary16(std::uint16_t bits) {
  const std::uint32_t sign = std::uint32_t{bits & 0x8000u} << 16;
  const std::uint32_t exponent = (bits >> 10) & 0x1Fu;
  const std::uint32_t fraction = bits & 0x3FFu;
  if (exponent == 31) return std::bit_cast<float>(sign | 0x7F800000u | fraction << 13);
  // Exponents are biased by 15 and 127, fractions have 10 and 23 bits.
  const std::uint32_t magnitude =
      exponent == 0 ? std::bit_cast<std::uint32_t>(static_cast<float>(fraction) * 0x1p-24F)
                    : (exponent + (127 - 15)) << 23 | fraction << 13;
  return std::bit_cast<float>(magnitude | sign);
}

}  // namespace fathom
