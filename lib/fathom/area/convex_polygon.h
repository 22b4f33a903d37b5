#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <unordered_map>
#include <vector>

#include "fathom/area/half_plane.h"

namespace fathom::area {

/// A box that certainly contains a polygon.
struct BoundingRectangle {
  Interval u{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Interval v = u;
  /// False only if two such boxes have no point in common.
  [[nodiscard]] bool may_meet(const BoundingRectangle& other) const {
    return u.lower <= other.u.upper && other.u.lower <= u.upper && v.lower <= other.v.upper &&
           other.v.lower <= v.upper;
  }
};

/// A bounded convex polygon of positive area, as the half-planes of its edges, none of which is
/// superfluous: each turns left from the one before, and two consecutive ones meet in a vertex.
/// No vertex is ever computed; every question is about a sign of coefficients.
///
/// A view: the half-planes must stay where they are.
class ConvexPolygon {
 public:
  /// From edges as described above.
  explicit ConvexPolygon(std::vector<const HalfPlane*> edges) : edges_(std::move(edges)) {
    find_bounds();
  }

  /// Cuts off what lies outside h: one step of Sutherland and Hodgman's algorithm. Returns false,
  /// and leaves a polygon that must not be used any more, if no area is left.
  /// Source   [SH74]
  bool clip(const HalfPlane& h, TierCounts& counts);

  [[nodiscard]] const std::vector<const HalfPlane*>& edges() const { return edges_; }
  /// The edge before or after edge k, which it meets in edge k's first or last vertex.
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

/// Half-planes of which equal ones are one object, so that edges that lie in one line are known by
/// their addresses. Lines of the same points come from triangles that are equal, share an edge, or
/// lie in a row, with coefficients that differ by a factor.
/// Exact    always: two are one if and only if they have the same points.
class MergedLines {
 public:
  MergedLines() = default;
  MergedLines(const MergedLines&) = delete;
  MergedLines& operator=(const MergedLines&) = delete;

  /// The one that stands for all with the points of h. It stays where it is; h is remembered by its
  /// address and must do so, too.
  const HalfPlane& of(const HalfPlane& h);
  /// The one on the other side of the line of h.
  const HalfPlane& opposite(const HalfPlane& h);
  /// The same polygon, bounded by those.
  ConvexPolygon of(const ConvexPolygon& polygon);

 private:
  const HalfPlane& find(const ExactVector3& coefficients);

  std::deque<HalfPlane> lines_;
  std::unordered_multimap<std::size_t, const HalfPlane*> by_hash_;
  std::unordered_map<const HalfPlane*, const HalfPlane*> known_, opposites_;
};

}  // namespace fathom::area
