#pragma once

#include <span>
#include <vector>

#include "fathom/area/convex_polygon.h"

/// Unions and differences of convex polygons, exactly and for every input: overlapping, touching,
/// with common edges, equal.
///
/// The boundary of the result is found edge by edge: from the line of each edge is taken what the
/// other polygons hide. On a line, a convex polygon is an interval, and the ends of two intervals
/// are compared by one determinant of three lines; nothing is constructed, so that numbers do not
/// grow. Edges that lie in one line count once where the polygons lie on one side of it, and
/// nowhere where they lie on both.
namespace fathom {

/// A part of the boundary: of `line`, from where it crosses `from` to where it crosses `to`. The
/// result lies on the left, on the right where `reversed`.
struct BoundarySegment {
  const HalfPlane* line = nullptr;
  const HalfPlane* from = nullptr;
  const HalfPlane* to = nullptr;
  bool reversed = false;
};
/// Of a polygon, or several, with holes; in no order. Empty where the result has no area.
using Boundary = std::vector<BoundarySegment>;

Boundary boundary_of_union(std::span<const ConvexPolygon> polygons, TierCounts& counts);

/// Of `subject` without the polygons.
Boundary boundary_of_difference(const ConvexPolygon& subject,
                                std::span<const ConvexPolygon> polygons, TierCounts& counts);

/// The area that a boundary encloses, exactly; 0 where it is empty.
Ratio area(const Boundary& boundary);

/// The same in binary64; 0 without an error where it is empty.
Certified<double> approximate_area(const Boundary& boundary);

}  // namespace fathom
