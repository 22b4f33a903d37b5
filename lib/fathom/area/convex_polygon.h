#pragma once

#include <limits>
#include <vector>

#include "fathom/area/half_plane.h"

namespace fathom {

/// A box that certainly contains a polygon.
struct BoundingRectangle {
  Interval u{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Interval v = u;
  /// False only where two such boxes have no point in common.
  [[nodiscard]] bool may_meet(const BoundingRectangle& other) const {
    return u.lower <= other.u.upper && other.u.lower <= u.upper && v.lower <= other.v.upper &&
           other.v.lower <= v.upper;
  }
};

/// A bounded convex polygon of positive area as the half-planes of its edges, none of them
/// superfluous: each turns left from the one before, and two consecutive ones meet in a vertex.
/// No vertex is ever computed; every question is a sign of coefficients.
///
/// A view: the half-planes must stay where they are.
class ConvexPolygon {
 public:
  /// From edges as above.
  explicit ConvexPolygon(std::vector<const HalfPlane*> edges) : edges_(std::move(edges)) {
    find_bounds();
  }

  /// Cuts off what lies outside of h: one step of Sutherland–Hodgman. Returns false, and leaves a
  /// polygon that is not to be used any more, where no area is left.
  /// Source   Ivan E. Sutherland and Gary W. Hodgman, Reentrant polygon clipping, CACM 17, 1974.
  bool clip(const HalfPlane& h, TierCounts& counts);

  [[nodiscard]] const std::vector<const HalfPlane*>& edges() const { return edges_; }
  /// The edge before or after edge k; with that it meets in the edge's first or last vertex.
  [[nodiscard]] const HalfPlane& before(std::size_t k) const {
    return *edges_[(k + edges_.size() - 1) % edges_.size()];
  }
  [[nodiscard]] const HalfPlane& after(std::size_t k) const {
    return *edges_[(k + 1) % edges_.size()];
  }
  [[nodiscard]] const BoundingRectangle& bounds() const { return bounds_; }

 private:
  void find_bounds();

  std::vector<const HalfPlane*> edges_;
  BoundingRectangle bounds_;
};

/// The coordinates of the point in which two lines cross.
struct CertifiedPoint {
  Certified<double> u, v;
};
CertifiedPoint approximate_crossing(const HalfPlane& a, const HalfPlane& b);

}  // namespace fathom
