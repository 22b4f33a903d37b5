#include "fathom/depth_format/encode.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

bool is_beyond_far(const DepthFormat& format, const Ratio& depth) {
  return !std::isinf(format.far) && compare(depth, Dyadic(format.far)) > 0;
}

std::string text_of(const Ratio& x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", round_to_binary64(x));
  return text;
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
