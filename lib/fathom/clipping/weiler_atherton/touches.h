#pragma once

#include <optional>
#include <variant>

#include "fathom/clipping/weiler_atherton/numbered_points.h"
#include "fathom/clipping/weiler_atherton/sweep.h"

/// Where rings of one side touch.
namespace fathom::clipping {

/// Two edges that cross within both, and a ring that has each.
struct EdgeCrossing {
  UndirectedEdge first, second;
  std::size_t first_ring, second_ring;
};

/// The rings, with every point in which one touches another entered as a corner, so that edges are
/// the same or meet only in ends: by a sweep, in which edges that touch keep their order. All such
/// points are corners of rings already. Or else a crossing, if there is one within an edge of each
/// ring. Each ring by itself is simple.
/// Cost     n log n, with n also the touches
/// Fails    InputError where there are more than `most_contacts` (contacts.h)
/// Source   [SH76]
std::variant<NumberedRings, EdgeCrossing> enter_touches(const NumberedRings& rings,
                                                        const PointOrder& points);

}  // namespace fathom::clipping
