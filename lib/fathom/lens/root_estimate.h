#pragma once

#include <array>

#include "fathom/lens/polynomial_stage.h"
#include "fathom/lens/sample_plane.h"
#include "fathom/numeric/interval.h"

namespace fathom::lens {

enum class Existence { yes, no, unknown };

/// The root of F (elimination.h) in the disc, as far as binary64 can tell.
struct RootEstimate {
  Existence existence = Existence::unknown;
  /// F is negative at `low` and positive at `high`, both in the disc.
  double low = 0, high = 0;
  /// Contains (m, 1).
  std::array<Interval, 3> box{};
};

/// Of y ≠ 0. All that is stated is proved by bounds on rounding errors; near the edge of the disc,
/// or with very large or small numbers, nothing is.
RootEstimate estimate_root(const PolynomialStage& stage, const DistortedPoint& y);

}  // namespace fathom::lens
