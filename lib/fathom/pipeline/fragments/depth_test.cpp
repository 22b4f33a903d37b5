#include "fathom/pipeline/fragments/depth_test.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "fathom/pipeline/scan/arithmetic.h"

namespace fathom::pipeline {
namespace {

/// The integer nearest to z·(2ⁿ − 1), ties to even: the product is exact in 128 bits.
std::uint64_t unorm_code(double z, int bits) {
  int exponent = 0;
  const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(z, &exponent), 53));
  const int shift = 53 - exponent;  // z = significand / 2^shift
  if (shift > 120) return 0;        // z < 2⁻⁶⁶
  const Int128 product = Int128{significand} * ((std::int64_t{1} << bits) - 1);
  const Int128 below = product >> shift, rest = product - (below << shift);
  const Int128 half = Int128{1} << (shift - 1);
  const bool up = rest > half || (rest == half && (below & 1) != 0);
  return static_cast<std::uint64_t>(below + (up ? 1 : 0));
}

template <class Real>
double mapped(const DepthFormat& f, Real depth) {
  const auto near = static_cast<Real>(f.near), far = static_cast<Real>(f.far);
  const auto c = static_cast<Real>(f.c), one = Real(1);
  Real z = 0;
  switch (f.mapping) {
    case Mapping::linear:
      z = (depth - near) / (far - near);
      break;
    case Mapping::w:
      z = depth / far;
      break;
    case Mapping::log:
      z = std::log(one + c * depth) / std::log(one + c * far);
      break;
    default:
      z = std::log(depth / near) / std::log(far / near);
      break;
  }
  return std::clamp(static_cast<double>(z), 0.0, 1.0);
}

}  // namespace

StoredDepth store(Storage storage, double z) {
  if (z <= 0) return {0};
  if (is_unorm(storage)) return {unorm_code(z, bits_of(storage))};
  if (storage == Storage::float32) return {std::bit_cast<std::uint32_t>(static_cast<float>(z))};
  if (storage == Storage::float64) return {std::bit_cast<std::uint64_t>(z)};
  return round_to_storage(storage, Real(Ratio(Dyadic(z))));
}

DepthTest::DepthTest(const PipelineOptions& options)
    : format_(options.depth_format),
      binary32_(options.precision == Precision::binary32),
      greater_is_nearer_(is_reversed(format_.mapping) !=
                         (options.depth_range[0] > options.depth_range[1])) {}

StoredDepth DepthTest::stored(const Fragment& fragment) const {
  if (!is_per_fragment(format_.mapping)) return store(format_.storage, fragment.window_z);
  return store(format_.storage, binary32_ ? mapped(format_, static_cast<float>(fragment.depth))
                                          : mapped(format_, fragment.depth));
}

}  // namespace fathom::pipeline
