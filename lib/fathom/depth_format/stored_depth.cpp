#include "fathom/depth_format/stored_depth.h"

#include <bit>
#include <stdexcept>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

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

}  // namespace fathom
