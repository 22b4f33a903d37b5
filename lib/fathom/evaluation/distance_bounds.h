#pragma once

#include <cmath>

#include "fathom/evaluation/placed_triangles.h"

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

/// Of a point and corners within bounds::point_error and bounds::corner_error of the exact ones.
DistanceBounds distance_bounds(const PlacedTriangles::Corners& corners, const Vector& p);

}  // namespace fathom::evaluation
