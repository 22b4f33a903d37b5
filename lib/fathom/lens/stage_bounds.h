#pragma once

#include <array>

#include "fathom/lens/stage.h"
#include "fathom/numeric/interval.h"

namespace fathom::lens {

/// What is known of a stage S on a box of the plane, for certificates in binary64.
struct StageBounds {
  /// (S(m) − S(m'))·(m − m') ≥ growth·|m − m'|² for all m and m' in the box: a lower bound on the
  /// least eigenvalue of the symmetric part of the Jacobian. 0: nothing is known.
  double growth = 0;
  /// A bound on the magnitudes of the terms of each component of S in the box, added up.
  double terms = 0;
  /// So many units of roundoff of `terms` bound the error of stage_value() in binary64, with any of
  /// its products and sums fused or not.
  double roundings = 0;
};

/// Of a box with finite ends.
StageBounds bounds_on_box(const StageNumbers<double>& stage, const std::array<Interval, 2>& box);

/// A bound on |S(m)| where |m|² = q; +∞ if none is known.
double greatest_on_circle(const StageNumbers<double>& stage, double q);

}  // namespace fathom::lens
