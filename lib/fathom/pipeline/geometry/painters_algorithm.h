#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fathom/numeric/interval.h"
#include "fathom/pipeline/geometry/window_triangle.h"

/// Exact signs for the painter's algorithm, for points (x, y, depth in the window).
namespace fathom::pipeline {

using Point3d = std::array<double, 3>;

/// The sign of det(b − a, c − a, p − a): mostly settled by a bound on the rounding of the
/// determinant in binary64, the rest by exact numbers.
Sign side_of_plane(const Point3d& a, const Point3d& b, const Point3d& c, const Point3d& p);

/// Whether two convex polygons overlap in x and y by more than their boundaries.
bool projections_overlap(const std::vector<Point3d>& p, const std::vector<Point3d>& q);

/// The sign of the turn a → b → c in x and y.
Sign turn_in_window(const Point3d& a, const Point3d& b, const Point3d& c);

/// Statistics of the painter's order: how often each of Newell's tests settled that a polygon may
/// be painted before another, and what was done if no test did.
struct PainterStatistics {
  std::array<std::uint64_t, 5> settled{};
  std::uint64_t z_disjoint = 0;   ///< polygons whose successors are entirely nearer
  std::uint64_t moved = 0;        ///< painted earlier than their farthest corner suggests
  std::uint64_t splits = 0;       ///< cut in two: cycles and penetration
  std::uint64_t comparisons = 0;  ///< pairs whose depths overlap
};

/// A polygon that the painter's algorithm orders: a triangle or, after splits, a part of one.
struct PaintedPolygon {
  std::uint32_t triangle = 0;                  ///< its number in the scene
  std::optional<std::size_t> part_of;          ///< index of the polygon that it was split from
  std::vector<std::array<double, 3>> corners;  ///< x, y, z in the window
};

/// A step of the painter's algorithm; P and Q are indices of polygons, P the first of the list.
struct PainterStep {
  enum class Kind {
    z_disjoint,  ///< Q lies wholly nearer: P may be painted before it
    settled,     ///< one of Newell's tests settles that P may be painted before Q
    moved,       ///< no test does: Q is tried before P
    split,       ///< `cut` is split into `behind` and `before`, which replace it
    forced,      ///< neither splits the other: P is painted before Q
    painted,     ///< P is painted
  };
  Kind kind = Kind::painted;
  std::size_t P = 0, Q = 0;
  int test = 0;  ///< 1 to 5, of `settled`
  std::size_t cut = 0, behind = 0, before = 0;
};

/// How a painting order came about.
struct PainterTrace {
  std::vector<PaintedPolygon>
      polygons;  ///< triangles in their first order, then parts as they arise
  std::vector<PainterStep> steps;
};

/// The painter's algorithm by Newell, Newell and Sancha: triangles are sorted by their farthest
/// corner; then P may be painted before every Q whose depths overlap its own if one of these holds:
///   1, 2  their boxes are disjoint in x, in y
///   3     P lies wholly behind the plane of Q
///   4     Q lies wholly in front of the plane of P
///   5     their projections do not overlap
/// Otherwise Q is tried before P; if that has been tried, a polygon is split by the plane of the
/// other. All tests are exact for the given window coordinates; the corners of pieces are rounded.
/// Source   [NNS72]
///
/// Returns  the triangles, pieces among them, in painting order.
/// Fails    InputError if more than a million pieces do not suffice, or if `trace` would get more
///          than 100,000 steps.
template <class Real>
std::vector<WindowTriangle<Real>> painters_order(std::vector<WindowTriangle<Real>> triangles,
                                                 bool greater_is_nearer,
                                                 PainterStatistics& statistics,
                                                 PainterTrace* trace = nullptr);

}  // namespace fathom::pipeline
