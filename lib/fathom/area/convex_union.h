#pragma once

#include <span>
#include <vector>

#include "fathom/area/convex_polygon.h"
#include "fathom/numeric/real.h"

/// Unions and differences of convex polygons, exactly and for every input: overlapping, touching,
/// with common edges, equal.
///
/// The boundary of the result is found edge by edge: the parts that other polygons hide are removed
/// from the line of each edge. On a line, a convex polygon is an interval, and the ends of two
/// intervals are compared by one determinant of three lines; nothing is constructed, so numbers do
/// not grow. Edges that lie in one line count once if the polygons are on the same side of it, and
/// not at all if they are on different sides.
namespace fathom::area {

/// A part of the boundary: `line` from its crossing with `from` to its crossing with `to`. The
/// result is on its left, or on its right if `reversed`.
struct BoundarySegment {
  const HalfPlane* line = nullptr;
  const HalfPlane* from = nullptr;
  const HalfPlane* to = nullptr;
  bool reversed = false;
};
/// The boundary of one or several polygons, with holes; in no order. Empty if there is no area.
using Boundary = std::vector<BoundarySegment>;

/// The boundary of a single polygon.
Boundary boundary_of(const ConvexPolygon& polygon);

Boundary boundary_of_union(std::span<const ConvexPolygon> polygons, TierCounts& counts);

/// The boundary of `subject` without the polygons.
Boundary boundary_of_difference(const ConvexPolygon& subject,
                                std::span<const ConvexPolygon> polygons, TierCounts& counts);

/// Terms, for some of the segments, whose sum is the area that a boundary encloses.
std::vector<Ratio> terms_of_area(const Boundary& boundary);

/// The area that a boundary encloses, exactly; 0 if it is empty.
Ratio exact_area(const Boundary& boundary);

/// An enclosure of exact_area(), in time proportional to the number of segments.
EnclosedSum enclosed_area(const Boundary& boundary);

/// exact_area() in binary64, with a bound; 0 without an error if it is empty.
Certified<double> approximate_area(const Boundary& boundary);

}  // namespace fathom::area
