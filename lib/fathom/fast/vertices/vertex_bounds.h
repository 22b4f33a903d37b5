#pragma once

#include "fathom/fast/vertices/vertex.h"

// Constants of the vertices' bounds; their derivations are where they are used (vertex.cpp,
// vertex_lanes.cpp). validation/proofs/vertices/vertex_*.gappa.in proves each.
namespace fathom::fast::vertex_bounds {

inline constexpr double affine_error = 6 * unit_roundoff<double>;
/// Relative error of U·(1/W), of 1/W, and of W where quotients by W have a bound.
inline constexpr double quotient_error = 3 * unit_roundoff<double>;
inline constexpr double reciprocal_error = unit_roundoff<double>;
inline constexpr double greatest_relative_error_of_W = 0x1p-20;
/// How often the errors of U and kW go into the linear form kW − U.
inline constexpr double missed_form = 1.5;
/// Relative slack of a bound: covers the roundings in its own evaluation (fewer than 2⁵ of them,
/// 2⁻⁴⁸) and the terms of second order named there (2⁻¹⁸).
inline constexpr double slack = 1 + 0x1p-15;
/// Absolute floor of every bound, above all effects of underflow: these are errors of 2⁻¹⁰⁷⁵ in U,
/// V, W or D, which divisions enlarge by at most 2¹⁵⁰.
inline constexpr double underflow_floor = 0x1p-100;

inline constexpr double least_W = 0x1p-60, greatest_W = 0x1p60;
inline constexpr double greatest_coordinate = 0x1p30;
inline constexpr double greatest_position_error = 0x1p-12;

}  // namespace fathom::fast::vertex_bounds
