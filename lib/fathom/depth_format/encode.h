#pragma once

#include <cstdint>
#include <optional>

#include "fathom/depth_format/depth_format.h"
#include "fathom/numeric/real.h"

/// Stored depths, exactly: the map f of a depth format, rounding to a storage, and back.
namespace fathom {

/// A stored depth value in [0, 1]: the code of a unorm storage, the bits of a float storage. In
/// both kinds greater values have greater `bits`, and neighbouring values have `bits` that differ
/// by one. It does not know its storage.
struct StoredDepth {
  std::uint64_t bits = 0;
  friend constexpr bool operator==(StoredDepth, StoredDepth) = default;
  friend constexpr bool operator<(StoredDepth a, StoredDepth b) { return a.bits < b.bits; }
  friend constexpr bool operator>(StoredDepth a, StoredDepth b) { return a.bits > b.bits; }
};

/// The stored value 1, the greatest; the least is 0.
StoredDepth greatest_stored(Storage storage);

/// The number in [0, 1] that a stored value represents; exact.
Ratio value_of(Storage storage, StoredDepth stored);

/// The stored value nearest to a number in [0, 1], ties to even.
/// Throws std::domain_error outside [0, 1].
StoredDepth round_to_storage(Storage storage, const Real& value);

/// The number halfway between a stored value, which must not be the greatest, and the next greater
/// one, where rounding steps.
Ratio boundary_above(Storage storage, StoredDepth stored);

// Depth buffers as OpenGL describes and reads them.

/// The storage of an attachment for which OpenGL reports so many bits per depth, as integers or
/// floating-point numbers.
///
/// Fails    InputError unless it has 16, 24 or 32 bits or is binary32.
Storage storage_of_attachment(int bits, bool is_floating_point);

/// The window depth, 0 to 1, of an integer as glReadPixels returns it for a unorm storage: 16 bits
/// as GL_UNSIGNED_SHORT, otherwise GL_UNSIGNED_INT, in which OpenGL puts 24 bits into the upper
/// bits.
///
/// Exact    rounded once.
double window_depth_of_pixel(Storage storage, std::uint32_t pixel);

// The map f of a depth format and its inverse. Neither depends on the storage or on whether the
// depth is between near and far.

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
