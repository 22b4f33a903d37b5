#pragma once

#include <array>

#include "fathom/numeric/ratio.h"

namespace fathom {

/// The rotation between two rotations at a constant rate, on the shorter way: the unit quaternion
///
///   sin((1 − s)·ω)/sin ω · p ± sin(s·ω)/sin ω · q
///
/// of the unit quaternions p and q of `from` and `to` with the angle ω ≤ 90° between them; the sign
/// is that of p·q, + if that is 0.
///
/// Needs    quaternions of finite numbers, of any length but 0, and 0 ≤ share ≤ 1.
/// Exact    `from` itself where share = 0, `to` itself where share = 1, and `from` where both are
///          the same rotation. Otherwise each component is computed with 320 bits and rounded to
///          binary64 once: it is the exact one rounded, unless the exact one lies within 2⁻²⁹⁰ of a
///          boundary of rounding.
/// Source   [Sho85]
std::array<double, 4> slerp(const std::array<double, 4>& from, const std::array<double, 4>& to,
                            const Ratio& share);

}  // namespace fathom
