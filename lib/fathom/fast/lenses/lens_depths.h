#pragma once

#include <array>
#include <cstdint>

#include "fathom/fast/lenses/lens_tile.h"

namespace fathom::fast {

/// The depths of a tile's surfaces rounded to binary32, by Tile::index(); +∞ where there is no
/// surface. Those that are open mean nothing.
struct LensDepths {
  alignas(64) std::array<float, TileShape::samples> depths;
  /// A bit for each sample: whether it shows a surface, and whether the bounds do not settle the
  /// depth of that. Four cells in each number.
  using Bits = std::array<std::uint64_t, TileShape::samples / 64>;
  Bits surface, open;

  [[nodiscard]] bool is_open(std::size_t i) const { return open[i / 64] >> i % 64 & 1; }
};

void round_depths(const LensTile& tile, LensDepths& rounded);

}  // namespace fathom::fast
