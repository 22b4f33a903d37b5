#pragma once

#include <string>
#include <vector>

#include "fathom/clipping/points.h"

/// Rings: their area, the checks of the polygon clippers, and convex pieces.
namespace fathom::clipping {

/// The sum, over double from the first to the last. Over Rational neighbours are added first: the
/// denominators of n fractions become n times as long, and in this order most sums remain short.
template <class Number>
Number sum_of(std::vector<Number> terms);

/// Half the sum of cross products: positive for counter-clockwise simple rings.
template <class Number>
Number signed_area(const Ring<Number>& ring);

/// The sum of the signed areas.
template <class Number>
Number signed_area(const Rings<Number>& rings);

/// The rings of one side as the clippers need them: corners that repeat the previous corner are
/// dropped, outlines run counter-clockwise and holes clockwise, so that the polygon (even-odd) lies
/// to the left. Rings may touch each other in points and along edges.
///
/// Fails    InputError "SIDE ring N …": a coordinate that is not finite, fewer than three distinct
///          corners, all corners on one line, a ring that meets itself, two rings that cross. The
///          tests are exact over both kernels.
template <class Number>
Rings<Number> checked_rings(const Rings<Number>& rings, const std::string& side);

/// Fails    InputError unless the counter-clockwise simple ring is convex; corners may be straight.
template <class Number>
void check_convex(const Ring<Number>& ring, const std::string& side);

/// The ring without its straight corners, starting from its least corner. The same point set always
/// gives the same list.
template <class Number>
Ring<Number> canonical(const Ring<Number>& ring);

/// A simple counter-clockwise ring as convex rings that do not overlap: ears are cut off until a
/// triangle is left; then diagonals whose ends remain convex without them are removed. At most four
/// times as many pieces as the least possible number. Clipping them one by one avoids
/// Sutherland–Hodgman's bridging edges, at the price of edges between the pieces.
///
/// Exact    over both kernels: every turn is decided exactly and no corner is added.
/// Fails    std::invalid_argument for rings that are not simple or clockwise, as far as it notices.
/// Source   [Mei75] for cutting ears; [HM83] for dropping diagonals.
template <class Number>
Rings<Number> convex_pieces(const Ring<Number>& ring);

}  // namespace fathom::clipping
