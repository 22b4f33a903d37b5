#pragma once

#include <array>
#include <optional>

#include "fathom/lens/stage.h"

/// Inverses of lenses as programs for calibrated cameras compute them: numbers of binary64, found
/// by iteration, without a bound on their error. Fathom's own inverse is exact (lens/preimages.h).
///
/// Each takes the stage S of a lens and a point y of the plane in which the lens distorts, and
/// returns a point m of the plane at depth 1 for which S(m) is near y.
namespace fathom::studies {

/// x and y of the ray (x, y, 1).
using PlanePoint = std::array<double, 2>;

/// cv::undistortPoints: from m = y, `steps` times m ← (y − t(m))/L(m), where t are the terms of S
/// that are not radial. OpenCV takes 5 steps unless it is asked for others, and checks nothing. The
/// result is y if L becomes negative.
/// Exact    each operation is rounded to binary64, in OpenCV's order.
/// Source   [OpenCV] version 4.6.0, modules/calib3d/src/undistort.dispatch.cpp
PlanePoint invert_by_fixed_point(const lens::StageNumbers<double>& stage, const PlanePoint& y,
                                 int steps);
inline constexpr int steps_of_opencv = 5;

/// COLMAP's IterativeUndistortion: Newton's method from m = y, until a step is shorter than 10⁻⁵.
/// Steps are cut to 0.1 or, if that is more, a tenth of |m|. nullopt after 100 steps.
/// Exact    each operation is rounded to binary64. COLMAP differentiates automatically; here the
///          derivatives are formulas, so the last bits may differ.
/// Source   [SZPF16] revision 5d968cf3, src/colmap/sensor/models.h
std::optional<PlanePoint> invert_by_newton(const lens::StageNumbers<double>& stage,
                                           const PlanePoint& y);

}  // namespace fathom::studies
