#include "fathom/depth_format/depth_bias.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

Ratio magnitude(const Ratio& x) {
  return {abs(x.numerator), x.denominator};
}

/// The exponent e with 2^e ≤ x < 2^(e+1), for x > 0.
long exponent_of(const Ratio& x) {
  // With the tops t and s of n and d, n / d lies in (2^(t−s−1), 2^(t−s+1)).
  const long e = x.numerator.top() - x.denominator.top();
  return compare(x, Dyadic(1.0).scaled(e)) < 0 ? e - 1 : e;
}

}  // namespace

Ratio resolvable_difference(Storage storage, const Ratio& greatest_z) {
  const StandardArithmetic standard;
  if (is_unorm(storage)) return {Dyadic(1.0), Dyadic(greatest_code(storage))};
  // Below the least normal number the steps stay as they are at that number.
  const long least = least_exponent(storage);
  const long e =
      greatest_z.sign() == Sign::zero ? least : std::max(exponent_of(magnitude(greatest_z)), least);
  return Dyadic(1.0).scaled(e - bits_of(storage));
}

Ratio depth_offset(Storage storage, const DepthBias& bias, const WindowSlopes& slopes) {
  const StandardArithmetic standard;
  const Ratio x = magnitude(slopes.dz_dx), y = magnitude(slopes.dz_dy);
  const Ratio m = x < y ? y : x;
  const Ratio r = resolvable_difference(storage, slopes.greatest_z);
  Ratio o = m * Dyadic(bias.slope_factor) + r * Dyadic(bias.constant_factor);
  if (std::isnan(bias.clamp) || std::isinf(bias.clamp) || bias.clamp == 0) return o;
  Ratio limit = Dyadic(bias.clamp);
  const bool beyond = bias.clamp > 0 ? limit < o : o < limit;
  return beyond ? limit : o;
}

Ratio biased_depth(const Ratio& window_depth, const Ratio& offset) {
  const StandardArithmetic standard;
  Ratio sum = window_depth + offset;
  if (sum.sign() == Sign::negative) return Ratio();
  const Ratio one = Dyadic(1.0);
  return one < sum ? one : sum;
}

}  // namespace fathom
