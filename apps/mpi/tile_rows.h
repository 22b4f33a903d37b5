#pragma once

#include <algorithm>
#include <cstdint>

#include "fathom/fast/some_tiles.h"

namespace fathom::app {

/// Calls visit(row, left, columns) for each row of pixels of a tile, from the top, in an image of
/// width × height pixels: `columns` of them from `left` on.
template <class Visit>
void for_each_row_of_tile(const ImageTiles& tiles, std::uint32_t tile, std::uint32_t width,
                          std::uint32_t height, const Visit& visit) {
  const std::uint32_t left = tile % tiles.columns * tiles.side;
  const std::uint32_t top = tile / tiles.columns * tiles.side;
  const std::uint32_t columns = std::min(tiles.side, width - left);
  const std::uint32_t rows = std::min(tiles.side, height - top);
  for (std::uint32_t row = top; row - top < rows; ++row) visit(row, left, columns);
}

}  // namespace fathom::app
