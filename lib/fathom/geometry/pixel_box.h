#pragma once

#include <cstdint>

namespace fathom {

/// Pixels of an image from a first to a last column and row; first > last where there is none.
struct PixelBox {
  std::uint32_t first_column = 1, last_column = 0;
  std::uint32_t first_row = 1, last_row = 0;
  [[nodiscard]] bool contains(std::uint32_t column, std::uint32_t row) const {
    return first_column <= column && column <= last_column && first_row <= row && row <= last_row;
  }
  [[nodiscard]] bool is_empty() const { return first_column > last_column || first_row > last_row; }
};

}  // namespace fathom
