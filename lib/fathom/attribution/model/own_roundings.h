#pragma once

namespace fathom::attribution {

/// The factor by which bounds are enlarged for the binary64 roundings of their own evaluation: each
/// bound is a sum of at least 2⁻²⁴ times magnitudes whose evaluation here, and that of the values
/// that they bound, errs by less than 2⁻⁴⁶ of the same magnitudes.
inline constexpr double own_roundings = 1 + 0x1p-20;

}  // namespace fathom::attribution
