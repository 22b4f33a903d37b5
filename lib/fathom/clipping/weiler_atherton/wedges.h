#pragma once

#include <vector>

#include "fathom/clipping/weiler_atherton/numbered_points.h"

/// Where closed lists pass through one point more than once: which way each goes on.
namespace fathom::clipping {

struct DirectedEdge {
  std::size_t from, to;
};

std::vector<DirectedEdge> edges_of(const NumberedRings& rings);

/// Closed lists that together run along every edge once. The edges bound a region, which lies to
/// their left; whoever comes to a point leaves it by the first edge clockwise from where it came:
/// the other border of the same wedge of the region. So parts of the region that only touch are
/// bounded apart, and what touches a border from within is joined to it. Where no point is passed
/// twice, there is nothing to choose.
///
/// Lists begin with the first edges, in the given order.
/// Fails    InputError if edges that come and go do not alternate about a point; over Rational that
///          cannot happen.
NumberedRings joined_by_wedges(const std::vector<DirectedEdge>& edges, const PointOrder& points);

/// Closed lists, taken apart where one passes through a point again, so that each ring is simple.
NumberedRings simple_rings(const NumberedRings& closed_lists, const PointOrder& points);

/// Rounding has made nonsense of how the rings lie.
[[noreturn]] void refuse_what_rounding_broke();

}  // namespace fathom::clipping
