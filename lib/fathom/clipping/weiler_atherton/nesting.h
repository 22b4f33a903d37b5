#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/points.h"
#include "fathom/clipping/weiler_atherton.h"
#include "fathom/clipping/weiler_atherton/numbered_points.h"

/// Which ring lies in which, by one sweep over all edges, and the polygons that lists make up: the
/// only form in which a region is returned.
namespace fathom::clipping {

/// For each ring the number of others that it lies in: even for outlines, odd for holes. Of
/// identical rings a later one lies in an earlier one.
/// Cost     n log n, and the pairs of rings that share an edge
/// Fails    InputError "SIDE rings M and N cross at (x, y)". The rings must be simple.
std::vector<int> nesting_depths(const Rings<Rational>& rings, const std::string& side);

/// For each ring that runs clockwise the outline (a ring that runs counter-clockwise) of the
/// polygon that it is a hole of; nullopt for outlines, and where rounding has left a hole without
/// one. Rings are simple and touch at most in points.
/// Cost     n log n
std::vector<std::optional<std::size_t>> outlines_around(const NumberedRings& rings,
                                                        const PointOrder& points);

/// The polygons of a region that lies to the left of closed lists; see weiler_atherton() for their
/// order. Where lists pass through a point again, with others or alone, parts of the region that
/// only touch are taken apart there (edge_order.h). Each clockwise ring goes to the outline
/// around it.
/// Fails    InputError where rounding has left a hole without an outline
template <class Number>
std::vector<Polygon<Number>> pieces_of(const NumberedRings& lists, const PointOrder& order,
                                       const std::vector<Point2<Number>>& points);

}  // namespace fathom::clipping
