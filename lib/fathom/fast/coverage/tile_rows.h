#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "fathom/fast/channels/map_rows.h"
#include "fathom/fast/coverage/pixel_area.h"
#include "fathom/fast/tiles/tile.h"

// Rows of a tile's pixels as words, a bit for each column, several rows at once.
namespace fathom::fast {

/// The pixels of a box within a tile, last ones included; empty where right < left or
/// bottom < top.
struct TileBox {
  std::int16_t left, right, top, bottom;
  [[nodiscard]] bool is_empty() const { return right < left || bottom < top; }
};

/// All pixels of a tile.
inline TileBox whole_tile(const PixelBox& area) {
  return {0, static_cast<std::int16_t>(area.last_column - area.first_column), 0,
          static_cast<std::int16_t>(area.last_row - area.first_row)};
}

using TileRows = std::array<std::uint64_t, Tile::size>;

inline std::uint64_t columns_between(int left, int right) {
  return ~std::uint64_t{0} << left & ~std::uint64_t{0} >> (63 - right);
}

/// Which samples show a surface, and which certainly show a front face (Tile::end_of_front()).
void look_at_samples(const Tile& tile, TileRows& shown, TileRows& front);

/// 1 where the bit is set, otherwise 0.
void to_coverage(std::uint64_t row, MapRow<float>& values);

// Of functions over a tile (tile_functions.h), and for pixels of a box that is not empty:
/// Sets the bits of some pixels throughout which all functions are certainly positive: in each row,
/// of all such pixels except one or two at the ends.
void add_pixels_inside(std::span<const UncertainHalfPlane> sides, const TileBox& box,
                       TileRows& rows);
/// The bits of the pixels in which all functions may have points that are not negative, and of one
/// or two more at the ends of a row. Other rows are left as they are.
void find_pixels_met(std::span<const UncertainHalfPlane> sides, const TileBox& box, TileRows& rows);

}  // namespace fathom::fast
