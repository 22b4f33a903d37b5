#pragma once

#include "fathom/numeric/standard_arithmetic.h"

// Constants of the interval of D at a sample (depth_interval-inl.h).
// validation/proofs/depth/depth_*.gappa.in and weight_row.gappa.in prove each.
namespace fathom::fast::resolve_bounds {

/// Relative room for the roundings of the ends of the interval, and of the factor that spreads it.
inline constexpr double end_room = 0x1p-50;
inline constexpr double spread_room = 1 + 0x1p-18;
/// Of the quotient in binary32 that 1/q is computed from: 1 − q·z.
inline constexpr double greatest_residual = 0x1p-21;
/// The greatest error of q, relative to q, for which 1/q has an interval.
inline constexpr double greatest_relative_error = 0x1p-21;

/// Of a quotient at a sample, of a weight for instance, from the inverse of its divisor
/// (surface_lanes.cpp; weight_row).
inline constexpr double weight_rounding = 5 * unit_roundoff<double>;

}  // namespace fathom::fast::resolve_bounds
