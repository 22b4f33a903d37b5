#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "fathom/numeric/real.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rendering/channel_values.h"
#include "fathom/rendering/options.h"

namespace fathom::triangle {

/// The factor from depths to codes in binary64, and by which part of itself the exact one may
/// differ.
struct CodeFactor {
  double value;
  double error = 0;
  /// As in DepthEncoding.
  bool beyond_is_none = false;
};

/// Where binary64 does not hold the factor, its error is one rounding, or without bound beyond the
/// normal numbers.
inline CodeFactor code_factor_of(const DepthEncoding& encoding) {
  const bool beyond_is_none = encoding.beyond_is_none;
  if (encoding.divisor == 1) return {encoding.scale, 0, beyond_is_none};
  const Ratio exact(encoding.scale, encoding.divisor);
  const auto nearest = round_to_normal(exact);
  if (!nearest) return {1, std::numeric_limits<double>::infinity(), beyond_is_none};
  return {*nearest, Ratio(*nearest) == exact ? 0 : unit_roundoff<double>, beyond_is_none};
}

// How depths and ray distances are rounded: once, as the map stores them.

/// A non-negative quantity x of a surface, or √x where `root`.
template <class X>
struct Quantity {
  X x;
  bool root;
};

inline float to_binary32(const Quantity<Ratio>& q) {
  return q.root ? round_sqrt_to_binary32(q.x) : round_to_binary32(q.x);
}
inline double to_binary64(const Quantity<Ratio>& q) {
  return q.root ? round_sqrt_to_binary64(q.x) : round_to_binary64(q.x);
}
inline std::optional<std::uint64_t> to_code(const Quantity<Ratio>& q) {
  return q.root ? round_sqrt_to_integer(q.x, 65535) : round_to_integer(q.x, 65535);
}

// The ends of an enclosure are compared as bits.
inline float to_binary32(const Quantity<Real>& q) {
  return std::bit_cast<float>(q.x.rounded([&](const Ratio& r) {
    return std::bit_cast<std::uint32_t>(to_binary32(Quantity<Ratio>{r, q.root}));
  }));
}
inline double to_binary64(const Quantity<Real>& q) {
  return std::bit_cast<double>(q.x.rounded([&](const Ratio& r) {
    return std::bit_cast<std::uint64_t>(to_binary64(Quantity<Ratio>{r, q.root}));
  }));
}
inline std::optional<std::uint64_t> to_code(const Quantity<Real>& q) {
  return q.x.rounded([&](const Ratio& r) { return to_code(Quantity<Ratio>{r, q.root}); });
}

/// Stores a quantity in the channel's type. `in_codes()` is the quantity that a code counts:
/// `scale` codes stand for `divisor` scene units.
template <class X, class InCodes>
std::optional<std::string> store(const rendering::EncodedValues& values, std::size_t pixel,
                                 const Quantity<X>& quantity, const DepthEncoding& encoding,
                                 const InCodes& in_codes) {
  if (values.binary32) {
    values.binary32[pixel] = to_binary32(quantity);
    return std::nullopt;
  }
  if (values.binary64) {
    values.binary64[pixel] = to_binary64(quantity);
    return std::nullopt;
  }
  const auto code = to_code(in_codes());
  if (!code && !encoding.beyond_is_none) return "above 65535";
  if (code == 0U) return "0, which means no surface";
  values.codes[pixel] = static_cast<std::uint16_t>(code.value_or(0));
  return std::nullopt;
}

inline std::optional<std::string> store(const rendering::EncodedValues& values, std::size_t pixel,
                                        const Quantity<Ratio>& quantity,
                                        const DepthEncoding& encoding) {
  return store(values, pixel, quantity, encoding, [&] {
    const Ratio factor(encoding.scale, encoding.divisor);
    return Quantity<Ratio>{quantity.x * (quantity.root ? factor * factor : factor), quantity.root};
  });
}

}  // namespace fathom::triangle
