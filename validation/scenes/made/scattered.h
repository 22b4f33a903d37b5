#pragma once

#include <cstdint>

namespace fathom::bench {

/// A permutation of 64-bit numbers that spreads every bit over all (the finalizer of SplitMix64).
inline std::uint64_t scattered(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

}  // namespace fathom::bench
