#pragma once

#include "fathom/evaluation/surface_points.h"
#include "fathom/evaluation/triangle_tree.h"
#include "fathom/numeric/ratio.h"

namespace fathom::evaluation {

/// How far points are from a surface. Binary64 with bounds finds the triangles that may be the
/// nearest; exact numbers decide between them. The scene and its parts must outlive it.
class NearestSurface {
 public:
  NearestSurface(const TriangleSource& source, const PlacedTriangles& triangles,
                 const TriangleTree& tree)
      : source_(source), triangles_(triangles), tree_(tree) {}

  /// The square of the distance from the nearest point of the surface, exactly; scene units. `p` is
  /// in the same unit as the triangles; there is one at least.
  [[nodiscard]] Ratio squared_distance(const PlacedPoint& p) const;

 private:
  const TriangleSource& source_;
  const PlacedTriangles& triangles_;
  const TriangleTree& tree_;
};

}  // namespace fathom::evaluation
