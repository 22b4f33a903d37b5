#pragma once

#include <array>
#include <optional>

#include "fathom/lens/stage.h"

/// Inverses of lenses as other programs compute them: steps in binary64 without a bound on the
/// error. Fathom's own inverse is exact (preimages.h).
///
/// Each takes the stage S of a lens and a point y of the plane in which the lens distorts, and
/// returns a point m for which S(m) is near y. All start from m = y.
namespace fathom::lens {

/// x and y of the ray (x, y, 1).
using PlanePoint = std::array<double, 2>;

/// cv::undistortPoints: `steps` times m ← (y − t(m))/L(m), where t are the terms of S that are not
/// radial. OpenCV takes 5 steps unless it is asked for others, and checks nothing. The result is y
/// if L becomes negative.
/// Needs    a single stage.
/// Exact    each operation is rounded to binary64, in OpenCV's order.
/// Source   [OpenCV] version 4.6.0, modules/calib3d/src/undistort.dispatch.cpp
PlanePoint invert_by_fixed_point(const StageNumbers<double>& stage, const PlanePoint& y, int steps);
inline constexpr int steps_of_opencv = 5;

/// `steps` times m ← m + y − S(m).
PlanePoint invert_by_residuals(const StageNumbers<double>& stage, const PlanePoint& y, int steps);

/// `steps` of Newton's method, of any length. Not finite where the Jacobian is singular.
PlanePoint invert_by_newton(const StageNumbers<double>& stage, const PlanePoint& y, int steps);

/// COLMAP's IterativeUndistortion: Newton's method until a step is shorter than 10⁻⁵. Steps are cut
/// to 0.1 or, if that is more, a tenth of |m|. nullopt after 100 steps.
/// Exact    each operation is rounded to binary64. COLMAP differentiates automatically and divides
///          in another order, so the last bits may differ.
/// Source   [SZPF16] revision 5d968cf3, src/colmap/sensor/models.h
std::optional<PlanePoint> invert_as_colmap(const StageNumbers<double>& stage, const PlanePoint& y);

}  // namespace fathom::lens
