#pragma once

#include <optional>

#include "fathom/depth_format/depth_format.h"
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

}  // namespace fathom
