#pragma once

#include <limits>

#include "fathom/numeric/rounding.h"
#include "fathom/numeric/unit_roundoff.h"
#include "fathom/rendering/options.h"

namespace fathom::triangle {

/// The factor from depths to codes in binary64, and by which part of itself the exact one may
/// differ.
struct CodeFactor {
  double value;
  double error = 0;
};

/// Where binary64 does not hold the factor, its error is one rounding, or without bound beyond the
/// normal numbers.
inline CodeFactor code_factor_of(const DepthEncoding& encoding) {
  if (encoding.divisor == 1) return {encoding.scale};
  const Ratio exact(encoding.scale, encoding.divisor);
  const auto nearest = round_to_normal(exact);
  if (!nearest) return {1, std::numeric_limits<double>::infinity()};
  return {*nearest, Ratio(*nearest) == exact ? 0 : unit_roundoff<double>};
}

}  // namespace fathom::triangle
