#pragma once

#include <vector>

#include "fathom/clipping/numbered_points.h"
#include "fathom/clipping/weiler_atherton.h"

/// The one form in which a region is answered.
namespace fathom::clipping {

/// The polygons of a region that lies to the left of closed lists; see weiler_atherton() for their
/// order. Where lists pass through a point again, with others or alone, parts of the region that
/// only touch are taken apart there (wedges.h). Each clockwise ring goes to the outline around it.
/// Fails    InputError where rounding has left a hole without an outline
template <class Number>
std::vector<Polygon<Number>> pieces_of(const NumberedRings& lists, const PointOrder& order,
                                       const std::vector<Point2<Number>>& points);

}  // namespace fathom::clipping
