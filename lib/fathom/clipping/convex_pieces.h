#pragma once

#include "fathom/clipping/points.h"

namespace fathom::clipping {

/// A simple counter-clockwise ring as convex ones that do not overlap: ears are cut off it until a
/// triangle is left, then the diagonals whose ends stay convex without them are dropped. At most
/// four times as many pieces as the least possible. Clipping them one by one avoids
/// Sutherland–Hodgman's bridging edges, at the price of edges between the pieces.
///
/// Exact    over both kernels: every turn is decided exactly and no corner is added.
/// Fails    std::invalid_argument for rings that are not simple or clockwise, as far as it notices.
/// Source   [Mei75] for cutting ears; [HM83] for dropping diagonals.
template <class Number>
Rings<Number> convex_pieces(const Ring<Number>& ring);

}  // namespace fathom::clipping
