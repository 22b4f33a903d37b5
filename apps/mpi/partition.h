#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace fathom::app {

/// How the tiles of an image are dealt out to the ranks of a run. The map does not depend on it.
enum class Partition {
  /// Runs of neighbouring tiles, row by row, of about equal work for their triangles and pixels.
  /// Neighbours share triangles, which then go to one rank.
  load,
  /// Whole rows of tiles, as many for each rank.
  rows,
  /// Tile t goes to rank t mod ranks: work is spread without being measured, and more is sent.
  round_robin
};

/// "load", "rows" or "round-robin".
/// Fails    UnknownName.
Partition parse_partition(const std::string& text);

/// The rank of each tile, of columns × rows of them. Ranks may be left without any.
/// `triangles`  how many may touch each tile.
std::vector<int> owners_of_tiles(Partition how, std::uint32_t columns, std::uint32_t rows,
                                 std::span<const std::uint64_t> triangles, int ranks);

}  // namespace fathom::app
