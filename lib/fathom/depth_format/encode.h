#pragma once

#include "fathom/depth_format/mapping.h"
#include "fathom/depth_format/stored_depth.h"

/// The ideal model: f is applied exactly and the result is rounded once (specification, section 9).
namespace fathom {

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
