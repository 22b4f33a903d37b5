#pragma once

#include "fathom/rays/placed_triangles.h"

/// Bounds on what binary64 loses where every coordinate is below 1 (power_of_unit). Each is proved
/// by a script of its name in validation/proofs; what underflows is less than 2⁻¹⁰⁰⁰ and lost in
/// them.
namespace fathom::evaluation::bounds {

/// How far a coordinate of a corner may be from the exact one: it is rounded once.
inline constexpr double corner_error = rays::placing_error;

/// The same of a point of a triangle, A + u·(B − A) + v·(C − A) with u and v in [0, 1]
/// (evaluation_point).
inline constexpr double point_error = 0x1p-49;

/// The same of the difference of such a point and a corner (evaluation_difference).
inline constexpr double difference_error = 0x1p-48;

/// Of the distance of a point from a box (evaluation_gap), and of both bounds on its distance from
/// a triangle (evaluation_place, evaluation_plane).
inline constexpr double distance_error = 0x1p-44;

}  // namespace fathom::evaluation::bounds
