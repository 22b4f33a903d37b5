#pragma once

#include <algorithm>
#include <cstdint>

#include "fathom/geometry/frames.h"

namespace fathom::fast {

/// How near a triangle can be at its samples in a tile, and where they are, in 32 bits: the
/// greatest q of a covered sample rounded up, as a binary32 number of 24 bits, and in the last
/// eight the block of the box's first sample (column, row: three bits each), whether the box meets
/// more than two by two blocks (four by four it meets at most), and whether the triangle, which is
/// there for its area, certainly covers no sample.
using Nearness = std::uint32_t;

/// Its parts.
inline constexpr Nearness nearness_of_q = 0xFFFFFF00, nearness_of_block = 0x3F,
                          nearness_of_more = 0x40, nearness_without_samples = 0x80;

/// The nearness of a triangle about which nothing is known: NaN, for which no comparison holds.
inline constexpr Nearness never_hidden = 0x7FC00000;

/// A bit pattern of binary32 moved up by one to two times 256 steps, with its last 8 bits cleared.
/// Numbers that overflow become NaN, as do negative numbers next to 0.
template <class Bits>
constexpr Bits moved_up_in_24_bits(Bits bits) {
  const bool negative = (bits & 0x80000000) != 0;
  return negative ? (bits & nearness_of_q) - 0x100 : (bits + 0x1FF) & nearness_of_q;
}

constexpr std::uint32_t block_of(Nearness n) {
  return n & nearness_of_block;
}
constexpr bool meets_more_than_two_blocks(Nearness n) {
  return (n & nearness_of_more) != 0;
}

/// `q`: moved_up_in_24_bits(), perhaps without samples; the blocks that the box in the tile meets.
inline Nearness nearness_in(std::uint32_t q, std::uint32_t first_column, std::uint32_t last_column,
                            std::uint32_t first_row, std::uint32_t last_row) {
  const std::uint32_t more = std::max(last_column - first_column, last_row - first_row);
  if (more > 3) return never_hidden;
  return q | (more > 1 ? nearness_of_more : 0) | first_row << 3 | first_column;
}

/// A triangle of a tile.
struct TileEntry {
  std::uint32_t number;
  Nearness nearness;
};

}  // namespace fathom::fast
