#pragma once

#include <algorithm>
#include <cstdint>

#include "apps/bench/parts/edge_setup.h"

namespace fathom::bench {

/// A block of 8 × 8 pixels, aligned to the image, as far as it lies in the box of a triangle.
struct PixelBlock {
  static constexpr std::int32_t side = 8;
  /// By column and row of the box; both ends belong to it.
  std::int32_t left, right, top, bottom;
  /// Whether one edge function is too small at all of its pixels, and whether none is at any: the
  /// greatest and the least are those at its corners. Exact.
  bool is_outside = false, is_inside = true;

  [[nodiscard]] std::uint64_t pixels() const {
    return static_cast<std::uint64_t>(right - left + 1) *
           static_cast<std::uint64_t>(bottom - top + 1);
  }
};

/// The block that begins at a column and row of the image, which are multiples of 8.
inline PixelBlock look_at_block(const EdgeSetup& s, std::int32_t column, std::int32_t row) {
  constexpr std::int32_t side = PixelBlock::side;
  PixelBlock b{std::max(column - s.first_column, 0),
               std::min(column + side - s.first_column, s.columns) - 1,
               std::max(row - s.first_row, 0), std::min(row + side - s.first_row, s.rows) - 1};
  for (std::size_t k = 0; k < 3; ++k) {
    const bool grows_right = s.right[k] > 0, grows_down = s.down[k] > 0;
    const std::int64_t greatest = s.start[k] + s.right[k] * (grows_right ? b.right : b.left) +
                                  s.down[k] * (grows_down ? b.bottom : b.top);
    const std::int64_t least = s.start[k] + s.right[k] * (grows_right ? b.left : b.right) +
                               s.down[k] * (grows_down ? b.top : b.bottom);
    b.is_outside |= greatest < s.least[k];
    b.is_inside &= least >= s.least[k];
  }
  return b;
}

struct BlockCounts {
  std::uint64_t tested = 0, outside = 0, inside = 0;
  /// In blocks that are neither.
  std::uint64_t pixels_tested = 0;

  void add(const PixelBlock& block) {
    ++tested;
    outside += block.is_outside;
    inside += block.is_inside;
    if (!block.is_outside && !block.is_inside) pixels_tested += block.pixels();
  }
};

/// visit(block) for the blocks that the box of a triangle meets.
template <class Visit>
void for_each_block(const EdgeSetup& s, const Visit& visit) {
  constexpr std::int32_t side = PixelBlock::side;
  for (std::int32_t row = s.first_row / side * side; row < s.first_row + s.rows; row += side)
    for (std::int32_t column = s.first_column / side * side; column < s.first_column + s.columns;
         column += side)
      visit(look_at_block(s, column, row));
}

}  // namespace fathom::bench
