#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "apps/mpi/ranks.h"
#include "apps/mpi/traffic.h"
#include "fathom/fast/some_tiles.h"
#include "fathom/image/depth_map.h"

namespace fathom::app {

/// Rows first ≤ row < end of tiles.
struct TileRows {
  std::uint32_t first = 0, end = 0;
  [[nodiscard]] std::uint32_t count() const { return end - first; }
};

/// About as many rows of tiles for each rank, the first of them for rank 0; for some perhaps none.
std::vector<TileRows> equal_bands(std::uint32_t rows, int ranks);
/// All of them for rank 0.
std::vector<TileRows> all_for_first(std::uint32_t rows, int ranks);

/// The parts of the ranks' bands that begin at row `from` of the band and have at most `most` rows.
std::vector<TileRows> parts_of(std::span<const TileRows> bands, std::uint32_t from,
                               std::uint32_t most);

/// Which rank has drawn each tile of an image.
struct DrawnTiles {
  ImageTiles tiles;
  std::uint32_t width = 0, height = 0;
  std::span<const int> of_tiles;
};

/// Makes the map of rows of tiles with values where this rank has drawn.
using RowsDrawn = std::function<DepthMap(const TileRows&)>;

/// Messages to the other ranks, one for each: the pixels that this rank has drawn of the rows that
/// the receiver compresses.
/// Fails    as `drawn` does.
std::vector<files::Bytes> pixels_for_others(const Ranks& ranks, const DrawnTiles& where,
                                            std::span<const TileRows> of_ranks,
                                            const RowsDrawn& drawn);
/// The map of this rank's rows, from pixels that it has drawn and pixels received from other ranks.
DepthMap rows_from_all(const Ranks& ranks, const DrawnTiles& where, const TileRows& own,
                       const RowsDrawn& drawn, const std::vector<files::Bytes>& from_others);

/// A map that is put together from rows, one after another.
class WholeMap {
 public:
  /// For an image of this height, with its first rows.
  WholeMap(DepthMap first_rows, std::uint32_t height);
  /// Appends the next rows; the same channels.
  void add(const std::vector<ImageChannel>& rows);
  [[nodiscard]] DepthMap take() { return std::move(map_); }

 private:
  DepthMap map_;
  std::size_t pixels_ = 0;
};

}  // namespace fathom::app
