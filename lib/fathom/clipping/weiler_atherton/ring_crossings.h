#pragma once

#include <optional>

#include "fathom/clipping/weiler_atherton/numbered_points.h"

/// Whether rings that touch cross each other.
namespace fathom::clipping {

struct RingCrossing {
  std::size_t first_ring, second_ring, point;
};

/// The first crossing of two rings, nullopt if rings at most touch, in points and along edges. Each
/// ring is simple, and contacts are entered: edges are the same or meet only in ends.
/// Cost     n log n, and the pairs of rings that share an edge
std::optional<RingCrossing> ring_crossing(const NumberedRings& rings, const PointOrder& points);

}  // namespace fathom::clipping
