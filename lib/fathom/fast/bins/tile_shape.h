#pragma once

#include <cstddef>
#include <cstdint>

namespace fathom::fast {

/// How many samples a tile has, and in which order they are kept.
struct TileShape {
  /// Columns and rows.
  static constexpr std::uint32_t size = 64;
  static constexpr std::uint32_t samples = size * size;
  static constexpr std::uint32_t block = 8;
  static constexpr std::uint32_t blocks_of_row = size / block;
  static constexpr std::size_t blocks = std::size_t{blocks_of_row} * blocks_of_row;

  /// Samples are kept by cells of 4 × 4, row by row of the tile, each row by row: a vector has as
  /// much of a cell as it can, always at the same place of memory, which a processor can hand from
  /// a write to the next read.
  static constexpr std::uint32_t cell = 4;
  /// Index of a sample by its column and row within the tile.
  static constexpr std::size_t index(std::uint32_t column, std::uint32_t row) {
    return (static_cast<std::size_t>(row / cell) * (size / cell) + column / cell) * (cell * cell) +
           row % cell * cell + column % cell;
  }
  /// Column and row of the sample at an index.
  static constexpr std::uint32_t column_of(std::size_t i) {
    return static_cast<std::uint32_t>(i / (cell * cell) % (size / cell) * cell + i % cell);
  }
  static constexpr std::uint32_t row_of(std::size_t i) {
    return static_cast<std::uint32_t>(i / (cell * size) * cell + i / cell % cell);
  }
};

}  // namespace fathom::fast
