#pragma once

#include <functional>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/geometry/frames.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {

/// A visible triangle and one at most `within` behind it (specification, section 8).
struct CoplanarPair {
  std::uint32_t visible = 0, behind = 0;
  /// The greatest lower bound of D_behind − D_visible, in scene units, over the points where
  /// 0 ≤ D_behind − D_visible and `visible` is visible. Rounded once to binary64.
  double separation = 0;
  /// Pixels in which the points that are close enough have an area, and a box around them.
  std::uint64_t pixels = 0;
  PixelBox box;
};

/// All coplanar pairs for the distance `within` ≥ 0, in scene units, by the numbers of their
/// triangles; without pairs that share the position of a corner. Of the options, only culling
/// and threads matter.
///
/// Exact    every decision. On a line D_s − D_t ≤ δ is a quadratic inequality, because D is a
///          quotient of affine forms; the least separation lies on the rim of the region, where the
///          inequality is decided for any δ, and so it is rounded by bisection.
/// Fails    InputError where scene or camera has a fault (find_fault); UsageError for a distance
///          that is negative or not finite.
std::vector<CoplanarPair> coplanar_pairs(const TriangleSource& triangles, const Camera& camera,
                                         double within, const RenderOptions& options,
                                         const std::function<void(double)>& progress = {});

}  // namespace fathom
