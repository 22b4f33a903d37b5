#pragma once

#include <cstdint>

namespace fathom {

/// A box of pixels, from its first to its last column and row; first > last where it is empty.
/// Column 0 is at the left, row 0 at the top.
struct PixelBox {
  std::uint32_t first_column = 1, last_column = 0;
  std::uint32_t first_row = 1, last_row = 0;
  [[nodiscard]] bool contains(std::uint32_t column, std::uint32_t row) const {
    return first_column <= column && column <= last_column && first_row <= row && row <= last_row;
  }
  [[nodiscard]] bool is_empty() const { return first_column > last_column || first_row > last_row; }
};

}  // namespace fathom
