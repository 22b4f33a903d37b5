#pragma once

#include "fathom/numeric/standard_arithmetic.h"

/// Bounds of the walk along a ray and of the tests of triangles in binary64. Coordinates of the
/// scene are below 1, of the origin below 8, of the direction below 2; u = 2⁻⁵³. The proofs are in
/// validation/proofs/rays.
namespace fathom::rays::bounds {

/// Boxes. Per axis, with the origin as an interval [o⁻, o⁺] of binary32 numbers around
/// o ± (ε + parallel_room), r = fl(1/d) and upper ≥ lower:
///   d ≥ least_slope   near = (lower − o⁺)·r, far = (upper − o⁻)·r·(1 + far_room) + underflow_room
///   d ≤ −least_slope  the same with lower and upper, o⁻ and o⁺ exchanged
///   otherwise         (−∞, ∞) if o⁻ ≤ upper and lower ≤ o⁺, else the box is missed
/// A box is visited if max(near, first) ≤ min(far, last).
/// No box is left out that the exact ray meets at an s of [first, last]. With v = 2⁻²⁴, a
/// difference of binary32 numbers, its product with r and r lose a factor in [1 − v, 1 + v] each,
/// and signs are right. So near ≤ s_near·(1 + v)³ and far ≥ s_far·(1 − v)³·(1 + 8v)(1 − v) for the
/// exact 0 ≤ s_near ≤ s_far; (1 + v)³/(1 − v)³ < 1 + 6.1v and (1 + 8v)(1 − v) > 1 + 6.9v. A near
/// below 0 is below every far ≥ 0, and far < 0 only if the exact one is. Underflow loses less than
/// 2⁻¹⁴⁸; adding underflow_room to a binary32 number never lowers it. `last` is rounded up and gets
/// the same factor. A component of d below least_slope moves the ray by less than 8·2⁻⁶⁰ =
/// parallel_room.
/// All of this is about one s, so the origin may move differently for each: longest_way times the
/// error of the direction is part of the error of the origin, as the ray leaves the scene, and all
/// boxes, before s = longest_way.
/// Source   [Ize13]; [WBW13] for the moved origin
inline constexpr double least_slope = 0x1p-60;
inline constexpr double parallel_room = 0x1p-57;
inline constexpr float far_room = 0x1p-21F;
inline constexpr float underflow_room = 0x1p-100F;
inline constexpr double longest_way = 8;
/// Leaves an origin that is near the scene below 8.
inline constexpr double greatest_origin_error = 0x1p-20;

/// The moved origin: exact but for one rounding of a coordinate below 8, and for less than 2⁻⁶⁰.
inline constexpr double moved_origin_error = 0x1p-49;

/// More than the loss by underflow in any value below.
inline constexpr double floor = 0x1p-900;
/// Covers terms of second order in u, and the roundings of the bounds themselves.
inline constexpr double slack = 1 + 0x1p-20;

/// Triangles. With p = b − a, r = c − a, t = a − o, T = │t│∞, D = │d_x│ + │d_y│ + │d_z│, γ the
/// error of a corner and ε that of the origin, H = max(│p│∞, │r│∞) + 4γ,
///   w_B = d·(r × t), w_C = d·(t × p), w = d·(p × r), w_A = (w − w_B) − w_C
/// in binary64. Rounding: components of r × t err by 8uHT (differences 2·2HT, products 2HT, their
/// difference 2HT), the sum with d by 3·2HT more: 14uDHT for w_B and for w_C, 14uDH² for w. w_A has
/// those of all three and of two sums of at most D(2H² + 2HT) and D(2H² + 4HT): 18uDH² + 34uDHT.
/// Corners and origin: p and r err by 2γ, t by γ + ε: w_B and w_C by D(4γT + 2H(γ + ε)), w by 8γDH,
/// w_A by the sum. So all four err by at most
///   E = D·(H·((T + H)·36u + 4(γ + ε)) + (T + H)·8γ)
/// Terms of second order in γ and ε are at most D·(16γ(γ + ε) + 32γ²), which the 4γ of H cover.
/// Direction: components that err by δ change w_B and w_C by 3δ·2HT, w by 3δ·2H², w_A by the sum,
///   δ·H·(T + H)·12
/// more. δ is at most 2⁻³⁶ (greatest_direction_error), so that slack covers its products with u, γ
/// and ε.
inline constexpr double of_products = 36 * unit_roundoff<double>;
inline constexpr double of_direction = 12;
inline constexpr double greatest_direction_error = 0x1p-36;
inline constexpr double of_origin = 4;
inline constexpr double of_corners = 8;
inline constexpr double size_room = 4;

/// n·t, n = p × r: components of n err by 8uH² + 8γH, t by uT + γ + ε, products and sums by
/// 3·6uH²T. Together
///   E_t = 48uH²T + 24γHT + 6H²(γ + ε)
/// and of second order 24γ²T + 24γH(γ + ε), which the 4γ of H cover, too.
inline constexpr double of_height = 48 * unit_roundoff<double>;
inline constexpr double of_height_corners = 24;
inline constexpr double of_height_origin = 6;

/// A component of n: 8uH² + 8γH.
inline constexpr double of_normal = 8 * unit_roundoff<double>;
inline constexpr double of_normal_corners = 8;

}  // namespace fathom::rays::bounds
