#pragma once

#include <cstdint>

#include "fathom/depth_format/depth_format.h"
#include "fathom/numeric/real.h"

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

}  // namespace fathom
