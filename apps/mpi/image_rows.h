#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/mpi/ranks.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/image/depth_map.h"

namespace fathom::app {

/// Which rank has drawn each tile of an image, and which one gets each row of tiles.
struct TilesAndRows {
  ImageTiles tiles;
  std::uint32_t width = 0, height = 0;
  std::span<const int> of_tiles;
  std::span<const int> of_rows;
};

/// Tiles travel: afterwards the map of each rank holds all pixels of the rows that it gets, of every
/// channel, whatever it holds elsewhere. A channel after the other, so that what travels at a time is
/// a rank's share of one.
void send_rows(const Ranks& ranks, const TilesAndRows& where, DepthMap& map);

}  // namespace fathom::app
