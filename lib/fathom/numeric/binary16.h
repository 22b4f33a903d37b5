#pragma once

#include <bit>
#include <cstdint>

namespace fathom {

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
