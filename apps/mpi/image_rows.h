#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/mpi/ranks.h"
#include "apps/mpi/traffic.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/image/depth_map.h"

namespace fathom::app {

/// Which rank has drawn each tile of an image, and which one gets each row of tiles: a band of
/// neighbouring rows, or none. The bands are in the order of the ranks.
struct TilesAndRows {
  ImageTiles tiles;
  std::uint32_t width = 0, height = 0;
  std::span<const int> of_tiles;
  std::span<const int> of_rows;
};

/// About as many rows of tiles for each rank, the first of them for rank 0.
std::vector<int> equal_bands(std::uint32_t rows, int ranks);

/// Tiles travel: returns the map of the rows that this rank gets, 0 rows where it gets none, with the
/// channels of `drawn`, in which it has drawn its tiles. A channel after the other, so that what
/// travels at a time is a rank's share of one. `traffic` counts what this rank sends.
DepthMap with_own_rows(const Ranks& ranks, const TilesAndRows& where, DepthMap drawn,
                       Traffic& traffic);

}  // namespace fathom::app
