#pragma once

#include "fathom/fast/vertex.h"

// Constants of the vertices' bounds; their derivations stand where they are used (fast_vertex.cpp,
// fast_vertex_lanes.cpp).
namespace fathom::vertex_bounds {

inline constexpr double affine_error = 6 * unit_roundoff<double>;
/// Relative slack of a bound: covers the roundings in its own evaluation (fewer than 2⁵ of them,
/// 2⁻⁴⁸) and the terms of second order named there (2⁻¹⁸).
inline constexpr double slack = 1 + 0x1p-15;
/// Absolute floor of every bound, above all effects of underflow: these are errors of 2⁻¹⁰⁷⁵ in U,
/// V, W or D, grown by at most 2¹⁵⁰ by divisions.
inline constexpr double underflow_floor = 0x1p-100;

inline constexpr double least_W = 0x1p-60, greatest_W = 0x1p60;
inline constexpr double greatest_coordinate = 0x1p30;
inline constexpr double greatest_position_error = 0x1p-12;

}  // namespace fathom::vertex_bounds
