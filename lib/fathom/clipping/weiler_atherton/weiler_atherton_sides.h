#pragma once

#include <string>

#include "fathom/clipping/points.h"

/// Weiler–Atherton, before step 1: a side whose rings touch each other.
namespace fathom::clipping {

/// The lists of one side: its rings as checked_rings() has them, if they are apart. Where rings
/// touch, in points or along edges, every edge that two of them have is dropped with its other (the
/// polygon lies on both sides of it or on neither), and the lists are joined_by_wedges(): they run
/// along the border of the polygon, and through one point perhaps more than once.
/// Exact    over both kernels: no point is new.
/// Fails    as checked_rings()
template <class Number>
Rings<Number> lists_of_side(const Rings<Number>& rings, const std::string& side);

}  // namespace fathom::clipping
