#pragma once

#include <optional>

#include "fathom/depth_format/depth_format.h"
#include "fathom/depth_format/stored_depth.h"
#include "fathom/numeric/real.h"

/// The map f of a depth format and its inverse, exactly. Neither depends on the storage or on
/// whether the depth is between near and far.
namespace fathom {

/// f(D), for D > 0, and D ≥ near for log-ulrich.
Real stored_value(const DepthFormat& format, const Ratio& depth);

/// The depth D with f(D) = `value`, for a value in [0, 1]; nullopt if that is infinite. It is a
/// rational number where it can be, even for logarithms.
std::optional<Real> depth_of(const DepthFormat& format, const Ratio& value);

/// a − b for two depths of one format (depth_of()), or a depth and a rational number; not for two
/// depths that are equal and irrational.
Real difference(const Real& a, const Real& b);

// The ideal model: f is applied exactly and the result is rounded once (specification, section 9).

/// The stored value of a planar depth in scene units.
/// Exact    the stored value nearest to f(depth), ties to even; monotone in the depth.
/// Fails    InputError if the depth is not between near and far.
StoredDepth encode(const DepthFormat& format, const Ratio& depth);

/// The depth that a stored value means, exactly; nullopt if that is infinite. It can lie outside
/// [near, far], where no depth is stored as this value.
std::optional<Real> decode(const DepthFormat& format, StoredDepth stored);

/// decode(), rounded once to binary64; +∞ if infinite.
double decode_to_binary64(const DepthFormat& format, StoredDepth stored);

/// `depth` if it is between near and far, else the nearer of these.
Ratio clamp_to_range(const DepthFormat& format, const Ratio& depth);

/// Which of two stored values wins a depth test: true if a is strictly nearer than b.
constexpr bool is_nearer(const DepthFormat& format, StoredDepth a, StoredDepth b) {
  return is_reversed(format.mapping) ? a > b : a < b;
}

}  // namespace fathom
