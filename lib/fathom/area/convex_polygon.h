#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <limits>
#include <unordered_map>
#include <vector>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/certified_value.h"

namespace fathom::area {

/// The points (u, v) with l_u·u + l_v·v + l_w ≥ 0, exactly; its line is l = 0. The normal (l_u,
/// l_v) is not zero, except in forms that are used for determinants only.
///
/// Two half-planes a, b with turn(a, b) > 0 meet in a vertex if they are edges of a convex polygon
/// that lies inside both; edges in this order go round counter-clockwise where v grows upwards
/// (clockwise on an image, where v grows downwards; areas are not affected).
/// Exact    every sign below: binary64 with a proved bound first, exact numbers where it fails.
class HalfPlane {
 public:
  /// Removes a power of two from the coefficients, so that the greatest is just below 1.
  explicit HalfPlane(ExactVector3 l);

  [[nodiscard]] const ExactVector3& exact() const { return exact_; }
  /// The given coefficients were exact()·2^exponent().
  [[nodiscard]] long exponent() const { return exponent_; }
  /// Within 2⁻⁵²·|l_k| + 2⁻¹⁰⁷⁴ of the exact coefficients; at most 1.
  [[nodiscard]] const std::array<double, 3>& approximate() const { return approximate_; }

 private:
  ExactVector3 exact_;
  long exponent_ = 0;
  std::array<double, 3> approximate_;
};

/// l_u, l_v or l_w for k = 0, 1, 2.
Certified<double> approximate_coefficient(const HalfPlane& l, std::size_t k);

/// a_u·b_v − a_v·b_u: positive if the line of b turns left from the line of a, 0 if they are
/// parallel.
Certified<double> approximate_turn(const HalfPlane& a, const HalfPlane& b);
Dyadic turn(const HalfPlane& a, const HalfPlane& b);
Sign sign_of_turn(const HalfPlane& a, const HalfPlane& b, TierCounts& counts);

/// det(a, b, c): 0 if the three lines meet in one point, or if they are parallel.
Certified<double> approximate_determinant(const HalfPlane& a, const HalfPlane& b,
                                          const HalfPlane& c);
Dyadic determinant(const HalfPlane& a, const HalfPlane& b, const HalfPlane& c);
Sign sign_of_determinant(const HalfPlane& a, const HalfPlane& b, const HalfPlane& c,
                         TierCounts& counts);

/// Whether the parallel lines of a and b have their insides on the same side.
bool same_side(const HalfPlane& a, const HalfPlane& b);

// Walk along the line of e with the inside of e on the left. The line of m, if not parallel to it,
// is crossed at a place τ, in units of the normal's length; there the walk enters m if
// turn(e, m) < 0, and leaves it otherwise.

/// The sign of τ(m) − τ(n).
Sign compare_crossings(const HalfPlane& e, const HalfPlane& m, const HalfPlane& n,
                       TierCounts& counts);
/// The sign of m at the place where e crosses `at`.
Sign side_of_crossing(const HalfPlane& m, const HalfPlane& e, const HalfPlane& at,
                      TierCounts& counts);

/// A box that certainly contains a polygon.
struct BoundingRectangle {
  Interval u{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Interval v = u;
  /// Returns false only if the two boxes have no point in common.
  [[nodiscard]] bool may_meet(const BoundingRectangle& other) const {
    return u.lower <= other.u.upper && other.u.lower <= u.upper && v.lower <= other.v.upper &&
           other.v.lower <= v.upper;
  }
};

/// A bounded convex polygon of positive area, as the half-planes of its edges. No edge is
/// superfluous: each turns left from the previous edge, and consecutive edges meet in a vertex. No
/// vertex is ever computed; every decision is the sign of an expression in the coefficients.
///
/// A view: the half-planes must not move.
class ConvexPolygon {
 public:
  /// From edges as described above.
  explicit ConvexPolygon(std::vector<const HalfPlane*> edges) : edges_(std::move(edges)) {
    find_bounds();
  }

  /// Clips the polygon at h: one step of Sutherland and Hodgman's algorithm. Returns false, and
  /// leaves an unusable polygon, if no area remains.
  /// Source   [SH74]
  bool clip(const HalfPlane& h, TierCounts& counts);

  [[nodiscard]] const std::vector<const HalfPlane*>& edges() const { return edges_; }
  /// The edge before or after edge k; it meets edge k in edge k's first or last vertex.
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

/// Half-planes in which equal half-planes are one object, so that edges in one line have the same
/// address. Lines with the same points but coefficients that differ by a factor come from triangles
/// that are equal, share an edge, or lie in a row.
/// Exact    always: two half-planes are one object if and only if they have the same points.
class MergedLines {
 public:
  MergedLines() = default;
  MergedLines(const MergedLines&) = delete;
  MergedLines& operator=(const MergedLines&) = delete;

  /// The object for all half-planes with the points of h. It never moves; h is remembered by its
  /// address and must not move either.
  const HalfPlane& of(const HalfPlane& h);
  /// The half-plane on the other side of the line of h.
  const HalfPlane& opposite(const HalfPlane& h);
  /// The same polygon, bounded by these objects.
  ConvexPolygon of(const ConvexPolygon& polygon);

 private:
  const HalfPlane& find(const ExactVector3& coefficients);

  std::deque<HalfPlane> lines_;
  std::unordered_multimap<std::size_t, const HalfPlane*> by_hash_;
  std::unordered_map<const HalfPlane*, const HalfPlane*> known_, opposites_;
};

}  // namespace fathom::area
