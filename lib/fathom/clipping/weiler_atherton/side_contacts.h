#pragma once

#include <optional>
#include <string>
#include <variant>

#include "fathom/clipping/points.h"
#include "fathom/clipping/weiler_atherton/edge_order.h"
#include "fathom/clipping/weiler_atherton/numbered_points.h"

/// Contacts within one side: where its rings touch, whether they cross and, before step 1 of
/// Weiler–Atherton, the lists of a side whose rings touch each other.
namespace fathom::clipping {

/// Two edges that cross within both, and a ring that has each.
struct EdgeCrossing {
  UndirectedEdge first, second;
  std::size_t first_ring, second_ring;
};

/// Enters every point in which a ring touches another as a corner, so that edges are equal or meet
/// only in ends, by a sweep in which touching edges keep their order. All such points are corners
/// of rings already. Returns a crossing instead if two rings cross within an edge of each. Each
/// ring by itself is simple.
/// Cost     n log n, with n also the touches
/// Fails    InputError if there are more than `most_contacts` (contacts.h)
/// Source   [SH76]
std::variant<NumberedRings, EdgeCrossing> enter_touches(const NumberedRings& rings,
                                                        const PointOrder& points);

struct RingCrossing {
  std::size_t first_ring, second_ring, point;
};

/// The first crossing of two rings, nullopt if rings at most touch, in points and along edges. Each
/// ring is simple, and contacts are entered: edges are the same or meet only in ends.
/// Cost     n log n, and the pairs of rings that share an edge
std::optional<RingCrossing> ring_crossing(const NumberedRings& rings, const PointOrder& points);

/// The lists of one side: its rings as checked_rings() has them, if they are apart. Where rings
/// touch, in points or along edges, every edge that two of them have is dropped with its other (the
/// polygon lies on both sides of it or on neither), and the lists are joined_by_wedges(): they run
/// along the border of the polygon, and through one point perhaps more than once.
/// Exact    over both kernels: no point is new.
/// Fails    as checked_rings()
template <class Number>
Rings<Number> lists_of_side(const Rings<Number>& rings, const std::string& side);

}  // namespace fathom::clipping
