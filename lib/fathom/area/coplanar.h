#pragma once

#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/geometry/pixel_box.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/triangle/options.h"

namespace fathom {

/// A visible triangle and one as far behind it as `within` at most (specification, section 8).
struct CoplanarPair {
  std::uint32_t visible = 0, behind = 0;
  /// The least upper bound of what D_behind − D_visible is nowhere below, over the points where
  /// both hold: 0 ≤ D_behind − D_visible, and `visible` is visible. Rounded once to binary64.
  double separation = 0;
  /// Pixels in which the points that are close enough have an area, and a box of them.
  std::uint64_t pixels = 0;
  PixelBox box;
};

/// All coplanar pairs for the distance `within` ≥ 0, by the numbers of their triangles: pairs that
/// share the position of a corner are not among them. Of the options culling, threads and progress
/// count.
///
/// Exact    every decision. On a line D_s − D_t ≤ δ is a quadratic inequality, because D is a
///          quotient of affine forms; the least separation lies on the rim of the region, where the
///          inequality is decided for any δ, and so is rounded by bisection.
/// Needs    a camera without fault; a finite distance.
std::vector<CoplanarPair> coplanar_pairs(const TriangleSource& triangles, const Camera& camera,
                                         double within, const RenderOptions& options);

}  // namespace fathom
