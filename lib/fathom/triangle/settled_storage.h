#pragma once

#include <cstddef>
#include <optional>

#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/certified_value.h"
#include "fathom/rendering/channel_values.h"
#include "fathom/triangle/stored_quantity.h"

/// Stores values that are known within a bound as a channel is encoded. Each function returns false
/// and stores nothing where the bound leaves the rounded value open; exact numbers then decide.
namespace fathom::triangle {

template <class T>
bool take(const std::optional<T>& rounded, T& target) {
  if (rounded) target = *rounded;
  return rounded.has_value();
}

inline bool take(const Certified<WordPair>& x, float& target) {
  return take(to_binary32(x.value, x.error), target);
}

/// Whether the number nearest to every number within the bound is above the greatest code.
inline bool is_certainly_beyond_codes(const WordPair& scaled, double error) {
  return scaled.hi * sign_room - error > 65536;
}

/// If the value is exact and a single word, its product with an exact factor is an exact
/// double-word.
inline bool store(const rendering::EncodedValues& values, std::size_t pixel,
                  const Certified<WordPair>& x, const CodeFactor& factor) {
  if (values.binary32) return take(x, values.binary32[pixel]);
  if (values.binary64) return take(to_binary64(x.value, x.error), values.binary64[pixel]);
  using Real = DoubleWord<false>;
  const Real scaled = Real(x.value) * factor.value;
  const bool is_exact = x.error == 0 && x.value.lo == 0 && factor.error == 0;
  // The effect of the factor's error on x.error is within the slack.
  const double error =
      is_exact ? 0 : (x.error * factor.value + scaled.hi * (epsilon<Real> + factor.error)) * slack;
  if (factor.beyond_is_none && is_certainly_beyond_codes(scaled, error)) {
    values.codes[pixel] = 0;
    return true;
  }
  return take(to_code(scaled, error), values.codes[pixel]);
}

/// The same of a value in binary64, for channels of binary32 and of codes.
inline bool store(const rendering::EncodedValues& values, std::size_t pixel,
                  const Certified<double>& x, const CodeFactor& factor) {
  if (values.binary32) return take(fathom::to_binary32(x.value, x.error), values.binary32[pixel]);
  return store(values, pixel, Certified<WordPair>{{x.value, 0}, x.error}, factor);
}

/// D − Z: hi − Z is exact, as Z is the binary32 number nearest to hi.
inline bool store_low_part(const Certified<WordPair>& depth, float& target) {
  const auto Z = to_binary32(depth.value, depth.error);
  if (!Z) return false;
  const WordPair low = two_sum(depth.value.hi - static_cast<double>(*Z), depth.value.lo);
  return take(to_binary32(low, depth.error), target);
}

}  // namespace fathom::triangle
