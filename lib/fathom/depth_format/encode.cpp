#include "fathom/depth_format/encode.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/numeric/transcendental.h"

namespace fathom {
namespace {

/// The value of a number in [0, 1] in an IEEE 754 format, from its bits.
Ratio exact_value_of_float(Storage storage, std::uint64_t bits) {
  const int fraction_bits = bits_of(storage);
  const std::uint64_t hidden = std::uint64_t{1} << fraction_bits;
  const auto exponent = static_cast<long>(bits >> fraction_bits);
  const std::uint64_t fraction = bits & (hidden - 1);
  const long least = least_exponent(storage) - fraction_bits;
  if (exponent == 0) return Dyadic(static_cast<double>(fraction)).scaled(least);
  return Dyadic(static_cast<double>(fraction | hidden)).scaled(least + exponent - 1);
}

/// The bits of a float storage nearest to an exact number.
std::uint64_t round_to_float(Storage storage, const Real& value) {
  switch (storage) {
    case Storage::float16:
      return round_to_binary16(value).bits;
    case Storage::float32:
      return std::bit_cast<std::uint32_t>(round_to_binary32(value));
    default:
      return std::bit_cast<std::uint64_t>(round_to_binary64(value));
  }
}

}  // namespace

StoredDepth greatest_stored(Storage storage) {
  if (is_unorm(storage)) return {greatest_code(storage)};
  return {static_cast<std::uint64_t>(1 - least_exponent(storage)) << bits_of(storage)};
}

Ratio value_of(Storage storage, StoredDepth stored) {
  const StandardArithmetic standard;
  if (!is_unorm(storage)) return exact_value_of_float(storage, stored.bits);
  return {Dyadic(static_cast<double>(stored.bits)), Dyadic(greatest_code(storage))};
}

StoredDepth round_to_storage(Storage storage, const Real& value) {
  const StandardArithmetic standard;
  if (is_unorm(storage)) {
    const std::optional<std::uint32_t> code = round_to_unorm(value, bits_of(storage));
    if (!code) throw std::domain_error("a depth format stores values in [0, 1]");
    return {*code};
  }
  const StoredDepth stored{round_to_float(storage, value)};
  if (stored > greatest_stored(storage)) {
    throw std::domain_error("a depth format stores values in [0, 1]");
  }
  return stored;
}

Ratio boundary_above(Storage storage, StoredDepth stored) {
  const StandardArithmetic standard;
  const Ratio sum = value_of(storage, stored) + value_of(storage, {stored.bits + 1});
  return {sum.numerator.scaled(-1), sum.denominator};
}

Storage storage_of_attachment(int bits, bool is_floating_point) {
  if (is_floating_point && bits == 32) return Storage::float32;
  for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::unorm32}) {
    if (!is_floating_point && bits == bits_of(storage)) return storage;
  }
  throw InputError("OpenGL: the depth attachment has " + std::to_string(bits) + " bits");
}

double window_depth_of_pixel(Storage storage, std::uint32_t pixel) {
  const std::uint32_t code = storage == Storage::unorm24 ? pixel >> 8 : pixel;
  return static_cast<double>(code) / greatest_code(storage);
}

namespace {

const Ratio& one() {
  static const Ratio value = Dyadic(1.0);
  return value;
}

}  // namespace

Real stored_value(const DepthFormat& format, const Ratio& depth) {
  const StandardArithmetic standard;
  const auto& D = depth;
  const Ratio near = Dyadic(format.near);
  // Mappings that know far only as infinity may have a far that no Dyadic can hold.
  const Ratio far = takes_infinite_far(format.mapping) ? Ratio() : Ratio(Dyadic(format.far));
  switch (format.mapping) {
    case Mapping::standard:
    case Mapping::opengl:
      return quotient(far * (D - near), D * (far - near));
    case Mapping::reversed:
      return quotient(near * (far - D), D * (far - near));
    case Mapping::infinite:
      return quotient(D - near, D);
    case Mapping::reversed_infinite:
      return quotient(near, D);
    case Mapping::linear:
      return quotient(D - near, far - near);
    case Mapping::w:
      return quotient(D, far);
    case Mapping::log: {
      const Ratio c = Dyadic(format.c);
      return quotient_of_logarithms(one() + c * D, one() + c * far);
    }
    case Mapping::log_ulrich:
      return quotient_of_logarithms(quotient(D, near), quotient(far, near));
  }
  return Ratio();
}

std::optional<Real> depth_of(const DepthFormat& format, const Ratio& value) {
  const StandardArithmetic standard;
  const auto& s = value;
  const Ratio near = Dyadic(format.near);
  const Ratio far = takes_infinite_far(format.mapping) ? Ratio() : Ratio(Dyadic(format.far));
  const auto quotient_or_infinity = [](const Ratio& a, const Ratio& b) -> std::optional<Real> {
    if (b.sign() == Sign::zero) return std::nullopt;
    return quotient(a, b);
  };
  switch (format.mapping) {
    case Mapping::standard:
    case Mapping::opengl:
      return quotient(near * far, far - s * (far - near));
    case Mapping::reversed:
      return quotient(near * far, near + s * (far - near));
    case Mapping::infinite:
      return quotient_or_infinity(near, one() - s);
    case Mapping::reversed_infinite:
      return quotient_or_infinity(near, s);
    case Mapping::linear:
      return near + s * (far - near);
    case Mapping::w:
      return s * far;
    case Mapping::log: {
      const Ratio c = Dyadic(format.c);
      return affine(power_minus_one(one() + c * far, s), quotient(one(), c), Ratio());
    }
    case Mapping::log_ulrich:
      return affine(power_minus_one(quotient(far, near), s), near, near);
  }
  return std::nullopt;
}

// a − b for two depths of one format (depth_of()), or a depth and a rational number.
//
// The difference is rational only if both are, or if they are equal (then the stored values are
// too, and it is not asked for). For logarithms let x be the least root of the base, b = r^k of a
// primitive r, such that both powers are powers of x: x = r^(1/m). X^m − r is irreducible over the
// rationals (r > 0 is not a p-th power for any prime p), so 1, x, …, x^(m−1) are linearly
// independent. A power x^i is a rational times x^(i mod m). If i mod m ≠ j mod m and not both are
// 0, the difference has an irrational part; if they are equal and not 0, it is x^(i mod m) times a
// rational that is not 0.
Real difference(const Real& a, const Real& b) {
  return {[a, b](long bits) {
            const Enclosure x = a.enclose(bits), y = b.enclose(bits);
            return Enclosure{x.low - y.high, x.high - y.low};
          },
          [a, b]() -> std::optional<Ratio> {
            const std::optional<Ratio> x = a.rational();
            if (!x) return std::nullopt;
            const std::optional<Ratio> y = b.rational();
            if (!y) return std::nullopt;
            return *x - *y;
          }};
}

namespace {

bool is_beyond_far(const DepthFormat& format, const Ratio& depth) {
  return !std::isinf(format.far) && compare(depth, Dyadic(format.far)) > 0;
}

std::string text_of(const Ratio& x) {
  char text[32];
  const double rounded = round_to_binary64(x);
  return {text, std::to_chars(text, text + sizeof text, rounded, std::chars_format::general).ptr};
}

}  // namespace

StoredDepth encode(const DepthFormat& format, const Ratio& depth) {
  const StandardArithmetic standard;
  const Ratio near = Dyadic(format.near);
  if (depth < near) {
    throw InputError("depth " + text_of(depth) + " is nearer than near = " + text_of(near));
  }
  if (is_beyond_far(format, depth)) {
    throw InputError("depth " + text_of(depth) +
                     " is farther than far = " + text_of(Dyadic(format.far)));
  }
  return round_to_storage(format.storage, stored_value(format, depth));
}

std::optional<Real> decode(const DepthFormat& format, StoredDepth stored) {
  const StandardArithmetic standard;
  return depth_of(format, value_of(format.storage, stored));
}

double decode_to_binary64(const DepthFormat& format, StoredDepth stored) {
  const StandardArithmetic standard;
  const std::optional<Real> depth = decode(format, stored);
  return depth ? round_to_binary64(*depth) : std::numeric_limits<double>::infinity();
}

Ratio clamp_to_range(const DepthFormat& format, const Ratio& depth) {
  const StandardArithmetic standard;
  if (depth < Dyadic(format.near)) return Dyadic(format.near);
  if (is_beyond_far(format, depth)) return Dyadic(format.far);
  return depth;
}

}  // namespace fathom
