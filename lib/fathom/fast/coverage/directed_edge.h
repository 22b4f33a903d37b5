#pragma once

#include <cstddef>
#include <cstdint>

// Directed edges between vertices less than 2³² − 1 as single words, of which none is 0 or 1.
namespace fathom::fast {

inline std::uint64_t word_of_edge(std::uint32_t from, std::uint32_t to) {
  return (std::uint64_t{from} + 1) << 32 | to;
}
inline std::uint32_t start_of_edge(std::uint64_t word) {
  return static_cast<std::uint32_t>((word >> 32) - 1);
}
inline std::uint32_t end_of_edge(std::uint64_t word) {
  return static_cast<std::uint32_t>(word);
}

/// Of 2^(64 − shift) places in a table, that of an edge and of its opposite (Fibonacci hashing,
/// [Knu98] 6.4).
inline std::size_t place_of_edge(std::uint32_t from, std::uint32_t to, int shift) {
  const std::uint64_t sum = std::uint64_t{from} + to, product = std::uint64_t{from} * to;
  return static_cast<std::size_t>(((sum ^ product << 1) * 0x9E3779B97F4A7C15) >> shift);
}

}  // namespace fathom::fast
