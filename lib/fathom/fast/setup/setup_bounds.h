#pragma once

#include "fathom/numeric/standard_arithmetic.h"

// Constants of the bounds of triangles; their derivations are where they are used (setup-inl.h,
// exact_setup.cpp). validation/proofs/ proves each, in the file that is named beside it.
namespace fathom::fast::setup_bounds {

// Names as in setup-inl.h: d, M, δ, L, T, dq.

/// area_error(): 4dM + 2d² + 5uM² (orientation). 2⁻⁴⁰ covers the roundings of the bound itself,
/// which the last term does not where d is above M/30.
inline constexpr double area_by_corners = 4 + 0x1p-40;
inline constexpr double area_rounding = 5 * unit_roundoff<double>;

/// box_margin(), relative to |coordinate| + 1 (box).
inline constexpr double box_margin = 0x1p-50;

/// certified_edges(): 8.25δL + 24uL² (edges).
inline constexpr double edge_by_corners = 8.25;
inline constexpr double edge_rounding = 24 * unit_roundoff<double>;

/// certified_depths(): (72δL + 230uL²)·dq/T + 4.1u|q_A|, where T is at least so many times the
/// bound on edge functions (q_gradient, q_area, q_bound). The bound leaves q_left of itself to
/// users, for their roundings (q_room).
inline constexpr double triangle_thinness = 16;
inline constexpr double q_by_corners = 72;
inline constexpr double q_rounding = 230 * unit_roundoff<double>;
inline constexpr double q_of_corner = 4.1 * unit_roundoff<double>;
inline constexpr double q_left = 0x1p-20;
inline constexpr double q_room = 1 + 2 * q_left;
/// By so many of its bounds a computed q is moved so that it lies beyond the exact one after
/// rounding (moved_q).
inline constexpr double q_moves = 2;

/// The functions of a batch in binary32 (lane_value): of the sum of the magnitudes of the terms,
/// with their own bound, as room for their users and for rounding the bound, and against underflow.
inline constexpr double lane_error = 5 * unit_roundoff<float>;
inline constexpr double lane_room = 1 + 0x1p-18;
inline constexpr double lane_floor = 0x1p-120;
/// Beyond it such a sum may overflow binary32.
inline constexpr double lane_limit = 0x1p100;
/// Below it sums of multiples of 2⁻¹⁷, as functions on the grid have, are exact in binary32.
inline constexpr double exact_lane_limit = 0x1p7;

/// q as a function over the whole tile: of the sum of the magnitudes of its terms (tile_q).
inline constexpr double tile_q_error = 12 * unit_roundoff<double>;

/// exact_setup() (exact_edges, exact_q). If the terms of q add up to greatest_q or more, q is
/// unknown.
inline constexpr double greatest_q = 0x1p100;
inline constexpr double exact_edge_error = 12 * unit_roundoff<double>;
inline constexpr double exact_q_error = 5 * unit_roundoff<double>;

/// wide_setup(): so many times the bound of a function in double-words, whose terms err by it each
/// (wide_edges); at most that much of the greatest term. Of the sum of three bounds, that of the
/// functions' difference (wide_difference).
inline constexpr double wide_terms = 3;
inline constexpr double wide_limit = 0x1p-40;
inline constexpr double wide_difference = 1.25;

/// moved_to(): so many times the bounds of exact_setup() (moved_exact_edges, moved_exact_q).
inline constexpr double moved_share = 2.5;

/// functions_over_tile(): so many times the bounds of exact_setup() (shape_edges).
inline constexpr double shape_share = 1.5;
/// The same, of an end of the range of depths (shape_q).
inline constexpr double range_end_rounding = 4 * unit_roundoff<double>;
/// edges_over_tile(): edge_rounding, and what moving by half a pixel adds (shape_of).
inline constexpr double shape_rounding = 34 * unit_roundoff<double>;

}  // namespace fathom::fast::setup_bounds
