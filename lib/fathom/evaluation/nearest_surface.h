#pragma once

#include <array>
#include <cmath>

#include "fathom/evaluation/box_tree.h"
#include "fathom/evaluation/placed_points.h"
#include "fathom/geometry/frames.h"
#include "fathom/numeric/ratio.h"

namespace fathom::evaluation {

inline Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double length(const Vector& v) {
  return std::sqrt(dot(v, v));
}

/// Bounds of the distance of an exact point from an exact triangle, in the unit of the triangles;
/// `lower` may be below 0.
struct DistanceBounds {
  double lower = 0, upper = 0;
};

/// Needs a point and corners within bounds::point_error and bounds::corner_error of the exact ones.
DistanceBounds distance_bounds(const PlacedTriangles::Corners& corners, const Vector& p);

/// The square of the distance of a point from the nearest point of a triangle, which may be without
/// area; scene units.
Ratio squared_distance(const WorldPoint& p, const std::array<WorldPoint, 3>& triangle);
Dyadic squared_distance(const WorldPoint& p, const WorldPoint& q);

/// How far points are from a surface. Binary64 with bounds finds the triangles that may be the
/// nearest; exact numbers decide between them. The scene and its parts must outlive it.
class NearestSurface {
 public:
  NearestSurface(const TriangleSource& source, const PlacedTriangles& triangles,
                 const BoxTree& tree)
      : source_(source), triangles_(triangles), tree_(tree) {}

  /// The square of the distance from the nearest point of the surface, exactly; scene units. `p` is
  /// in the same unit as the triangles; there is one at least.
  [[nodiscard]] Ratio squared_distance(const PlacedPoint& p) const;

 private:
  const TriangleSource& source_;
  const PlacedTriangles& triangles_;
  const BoxTree& tree_;
};

/// How far points are from the nearest point of a cloud, by the same means.
class NearestPoint {
 public:
  NearestPoint(const PlacedCloud& cloud, const BoxTree& tree) : cloud_(cloud), tree_(tree) {}

  /// The square of the distance, exactly; scene units. `p` is in the same unit as the cloud, which
  /// has one point at least.
  [[nodiscard]] Ratio squared_distance(const PlacedPoint& p) const;

 private:
  const PlacedCloud& cloud_;
  const BoxTree& tree_;
};

}  // namespace fathom::evaluation
