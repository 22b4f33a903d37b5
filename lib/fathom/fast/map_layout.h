#pragma once

#include <cstddef>
#include <cstdint>

namespace fathom::fast {

/// Where a map has the pixels of an image: from a row of the image on, row by row.
struct MapLayout {
  std::uint32_t width;
  std::uint32_t first_row = 0;

  [[nodiscard]] std::size_t pixel(std::uint32_t column, std::uint32_t row) const {
    return std::size_t{row - first_row} * width + column;
  }
};

}  // namespace fathom::fast
