#pragma once

#include "fathom/clipping/points.h"

namespace fathom::clipping {

/// A simple counter-clockwise ring as convex ones that do not overlap: ears are cut off it until a
/// triangle is left, then the diagonals are dropped whose ends stay convex without them. At most
/// four times as many pieces as the least possible. Clipped one by one, they are the cure for
/// Sutherland–Hodgman's bridging edges, at the price of edges between the pieces.
///
/// Exact    over both kernels: every turn is decided exactly and no corner is added.
/// Fails    std::invalid_argument for rings that are not simple or clockwise, as far as it notices.
/// Source   G. H. Meisters, Polygons have ears, American Mathematical Monthly 82, 1975; S. Hertel
///          and K. Mehlhorn, Fast triangulation of simple polygons, FCT 1983.
template <class Number>
Rings<Number> convex_pieces(const Ring<Number>& ring);

}  // namespace fathom::clipping
