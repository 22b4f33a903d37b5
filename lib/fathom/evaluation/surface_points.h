#pragma once

#include <cstdint>
#include <vector>

#include "fathom/evaluation/box_tree.h"
#include "fathom/geometry/frames.h"
#include "fathom/rays/sight.h"

namespace fathom::evaluation {

/// `count` points of a surface, as many on one part as on another of the same area, without chance:
/// they stand at equal distances in the running sum of the triangles' areas, and within their
/// triangles where the R₂ sequence puts them. Weights are at least 0, with a sum of at most 1, and
/// multiples of 2⁻²⁵. They depend on the surface and `count` only.
/// Exact    a point is on its triangle; the areas by which they are dealt out are rounded
/// Fails    InputError where the triangles have no area that binary64 can tell from 0
/// Source   [Rob18]
std::vector<SurfacePoint> surface_points(const PlacedTriangles& triangles, std::uint32_t count);

/// A point in the world, and in the unit of the triangles, where each coordinate is within
/// bounds::point_error of the exact one.
struct PlacedPoint {
  WorldPoint exact;
  Vector near;
};
PlacedPoint placed(const SurfacePoint& point, const TriangleSource& source,
                   const PlacedTriangles& triangles);

}  // namespace fathom::evaluation
