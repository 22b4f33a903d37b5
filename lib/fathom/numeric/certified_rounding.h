#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "fathom/numeric/double_word.h"

/// Correct rounding of a number known up to an error: |computed − exact| ≤ error. A rounded number
/// is returned only if every number that the bound allows rounds to it, without ties; so it is the
/// exact number rounded once (specification, section 6). nullopt: not settled. An error that is +∞
/// or NaN, or a value that is NaN, settles nothing.
namespace fathom {

/// Magnitudes for which the bounds of the fast engine's channels are derived.
inline constexpr double least_safe = 0x1p-100, greatest_safe = 0x1p100;

/// The relative widening of an interval for the rounding of its ends, and of a distance for its own
/// rounding (validation/proofs/depth/rounding_*.gappa.in).
inline constexpr double interval_widening = 0x1p-51, distance_room = 1 + 0x1p-50;
/// How much of the leading word certainly is of the number.
inline constexpr double sign_room = 1 - 0x1p-50;

/// The sign of a number that is certainly not 0: |hi + lo| ≥ |hi|·(1 − u), and the factor covers
/// the rounding of the product, too. Exact zeroes are not known, either.
inline std::optional<int> certain_sign(const WordPair& x, double error) {
  if (!(std::abs(x.hi) * sign_room > error)) return std::nullopt;
  return x.hi > 0 ? 1 : -1;
}

/// Rounding is monotone, so it is enough that both ends of the interval round to the same number.
/// The ends are moved outwards by 2⁻⁵¹ of themselves, for their own rounding. An interval that
/// contains 0 is not settled, unless it is the point 0.
inline std::optional<float> to_binary32(double value, double error) {
  if (value == 0 && error == 0) return 0.0F;
  const double margin = error + std::abs(value) * interval_widening;
  const double low = value - margin, high = value + margin;
  if (!(low > 0) && !(high < 0)) return std::nullopt;
  const auto rounded = static_cast<float>(low);
  if (rounded != static_cast<float>(high)) return std::nullopt;
  return rounded;
}

/// Half the distance from |x| to the next number towards 0, the nearer of its two neighbours; x
/// must be normal.
inline double half_gap(float x) {
  const float size = std::abs(x);
  const auto next = std::bit_cast<float>(std::bit_cast<std::uint32_t>(size) - 1);
  return 0.5 * (static_cast<double>(size) - static_cast<double>(next));
}
inline double half_gap(double x) {
  const double size = std::abs(x);
  return 0.5 * (size - std::bit_cast<double>(std::bit_cast<std::uint64_t>(size) - 1));
}

/// The candidate f is the nearest to hi; hi − f is exact (both are multiples of the last bit of
/// hi), the rest is rounded once: a number whose distance to f is below half of the smaller gap
/// next to f rounds to f. The conversion rounds an exact binary64 number once, even if it is a tie;
/// + 0.0 turns −0 into +0, because an exact zero is +0.
inline std::optional<float> to_binary32(const WordPair& x, double error) {
  if (error == 0 && x.lo == 0) return static_cast<float>(x.hi + 0.0);
  const double size = std::abs(x.hi);
  if (!(size >= least_safe && size <= greatest_safe)) return std::nullopt;
  const auto candidate = static_cast<float>(x.hi);
  const double rest = (x.hi - static_cast<double>(candidate)) + x.lo;
  if (!(std::abs(rest) * distance_room + error < half_gap(candidate))) return std::nullopt;
  return candidate;
}

inline std::optional<double> to_binary64(const WordPair& x, double error) {
  if (error == 0 && x.lo == 0) return x.hi + 0.0;
  const double size = std::abs(x.hi);
  if (!(size >= least_safe && size <= greatest_safe)) return std::nullopt;
  if (!((std::abs(x.lo) + error) * distance_room < half_gap(x.hi))) return std::nullopt;
  return x.hi;
}

/// The 16-bit code nearest to x, ties to even; nullopt also if it would be 0 or above 65535. If x
/// is known exactly and is a binary64 number, a tie is settled too.
inline std::optional<std::uint16_t> to_code(const WordPair& x, double error) {
  if (!(x.hi > 0.25 && x.hi < 65536)) return std::nullopt;
  auto code = static_cast<std::uint32_t>(x.hi);
  const double fraction = x.hi - code;
  if (fraction > 0.5 || (fraction == 0.5 && code % 2 == 1)) ++code;
  const bool is_exact = error == 0 && x.lo == 0;
  const double rest = (x.hi - code) + x.lo;
  if (!is_exact && !(std::abs(rest) * distance_room + error < 0.5)) return std::nullopt;
  if (code == 0 || code > 65535) return std::nullopt;
  return static_cast<std::uint16_t>(code);
}

}  // namespace fathom
