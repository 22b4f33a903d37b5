#pragma once

#include <vector>

#include "fathom/clipping/plane.h"
#include "fathom/clipping/points.h"

/// Reentrant polygon clipping: the polygon is clipped at one boundary after another.
/// Source   [SH74], with its symbols: the edge from S to P.
///
/// The result is always a single ring. If a concave polygon falls into pieces, bridging edges,
/// which run along the boundary and back, join them. The signed area is still right;
/// weiler_atherton.h gives the pieces.
namespace fathom::clipping {

/// A corner with its attributes, which are linear along every edge.
template <template <class> class Point, class Number>
struct Corner {
  Point<Number> position;
  std::vector<Number> attributes;
};
template <class Number>
using Corner2 = Corner<Point2, Number>;
template <class Number>
using Corner3 = Corner<Point3, Number>;
template <class Number>
using Corner4 = Corner<Point4, Number>;

template <template <class> class Point, class Number>
Corner<Point, Number> interpolate(const Corner<Point, Number>& a, const Corner<Point, Number>& b,
                                  const Number& t) {
  Corner<Point, Number> between{interpolate(a.position, b.position, t), {}};
  for (std::size_t i = 0; i < a.attributes.size(); ++i)
    between.attributes.push_back(interpolate(a.attributes[i], b.attributes[i], t));
  return between;
}

/// The polygon after one boundary. `outside(position)` is affine, positive outside, 0 on the
/// boundary, which counts as inside. There is a new corner where an edge crosses from strictly
/// inside to strictly outside or back; it is computed from the inner end of the edge, so both
/// polygons at a shared edge get the same corner, even over double. A polygon that only touches the
/// boundary from outside leaves nothing.
template <template <class> class Point, class Number, class Outside>
std::vector<Corner<Point, Number>> clip_at_boundary(
    const std::vector<Corner<Point, Number>>& polygon, const Outside& outside) {
  std::vector<Corner<Point, Number>> clipped;
  bool some_strictly_inside = false, some_outside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto& S = polygon[i == 0 ? polygon.size() - 1 : i - 1];
    const auto& P = polygon[i];
    const Number s = outside(S.position), p = outside(P.position);
    if (s < 0 && p > 0) clipped.push_back(interpolate(S, P, Number(s / (s - p))));
    if (s > 0 && p < 0) clipped.push_back(interpolate(P, S, Number(p / (p - s))));
    if (p <= 0) clipped.push_back(P);
    some_strictly_inside = some_strictly_inside || p < 0;
    some_outside = some_outside || p > 0;
  }
  if ((some_outside && !some_strictly_inside) || clipped.size() < 3) clipped.clear();
  return clipped;
}

/// The polygon after each boundary, in order.
template <template <class> class Point, class Number>
using ClipStages = std::vector<std::vector<Corner<Point, Number>>>;

/// A polygon in the plane against the edges of a convex polygon, which runs counter-clockwise.
/// Exact    over Rational.
template <class Number>
std::vector<Corner2<Number>> sutherland_hodgman(const std::vector<Corner2<Number>>& subject,
                                                const Ring<Number>& convex,
                                                ClipStages<Point2, Number>* trace = nullptr);

/// A polygon in space against planes whose normals point to the removed side. A polygon that lies
/// in a plane remains.
/// Exact    over Rational.
/// Fails    InputError if a normal is zero.
template <class Number>
std::vector<Corner3<Number>> sutherland_hodgman(const std::vector<Corner3<Number>>& subject,
                                                const std::vector<Plane<Number>>& planes,
                                                ClipStages<Point3, Number>* trace = nullptr);

/// Corners without attributes, and back.
template <class Number>
std::vector<Corner2<Number>> corners_of(const Ring<Number>& ring) {
  std::vector<Corner2<Number>> corners;
  for (const Point2<Number>& p : ring) corners.push_back({p, {}});
  return corners;
}
template <class Number>
Ring<Number> ring_of(const std::vector<Corner2<Number>>& corners) {
  Ring<Number> ring;
  for (const Corner2<Number>& corner : corners) ring.push_back(corner.position);
  return ring;
}

}  // namespace fathom::clipping
