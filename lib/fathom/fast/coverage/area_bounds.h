#pragma once

#include "fathom/numeric/unit_roundoff.h"

// Constants of the bounds on areas; their derivations are where they are used.
// validation/proofs/areas/area_*.gappa.in proves each.
namespace fathom::fast::area_bounds {

/// x of an edge at a height, in units of its greatest |x| (square_edges.h).
inline constexpr double crossing_error = 16 * unit_roundoff<double>;
/// What moving the ends of an edge, or the corners of a triangle, by ε does to an area, over ε.
inline constexpr double moved_edge = 4.1, moved_triangle = 16;
/// The same for an edge, over ε times its length near the square, and for its ends, over ε².
inline constexpr double moved_length = 2.83, moved_end = 6.3;
/// A cut by a line: error/max(|a|, |b|), and its own roundings (pixel_union.cpp).
inline constexpr double cut_error = 8, cut_rounding = 64 * unit_roundoff<double>;

/// Coordinates of at most `far` pixels are computed within rounding_room, also along edges whose
/// ends differ by least_rise in height (tile_outlines.cpp; row_of_edge).
inline constexpr double far = 0x1p28, rounding_room = 0x1p-20, least_rise = 0x1p-20;

}  // namespace fathom::fast::area_bounds
