#include "apps/bench/parts/tile_drawing.h"

#include <algorithm>
#include <numeric>

#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"

namespace fathom::bench {
namespace {

struct TileGrid {
  std::uint32_t side, columns, rows;

  /// visit(number of the tile) for the tiles that a box meets.
  template <class Visit>
  void for_each_tile(const EdgeSetup& s, const Visit& visit) const {
    const auto tile_of = [&](std::int32_t pixel) {
      return static_cast<std::uint32_t>(pixel) / side;
    };
    const std::uint32_t right = tile_of(s.first_column + s.columns - 1);
    const std::uint32_t bottom = tile_of(s.first_row + s.rows - 1);
    for (std::uint32_t row = tile_of(s.first_row); row <= bottom; ++row)
      for (std::uint32_t column = tile_of(s.first_column); column <= right; ++column)
        visit(row * columns + column);
  }
};

/// For each tile its triangles, in their order.
struct Bins {
  std::vector<std::uint32_t> sorted;
  std::vector<std::size_t> starts;

  Bins(std::span<const EdgeSetup> setups, const TileGrid& grid)
      : starts(std::size_t{grid.columns} * grid.rows + 1) {
    for (const EdgeSetup& s : setups)
      grid.for_each_tile(s, [&](std::uint32_t tile) { ++starts[tile + 1]; });
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    sorted.resize(starts.back());
    std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
    for (std::size_t i = 0; i < setups.size(); ++i) {
      grid.for_each_tile(setups[i], [&](std::uint32_t tile) {
        sorted[next[tile]++] = static_cast<std::uint32_t>(i);
      });
    }
  }
  [[nodiscard]] std::span<const std::uint32_t> in_tile(std::size_t tile) const {
    return std::span(sorted).subspan(starts[tile], starts[tile + 1] - starts[tile]);
  }
};

void copy(DepthImage& tile, DepthImage& image) {
  const std::uint32_t columns = std::min(tile.depths.width, image.depths.width - tile.first_column);
  const std::uint32_t rows = std::min(tile.depths.height, image.depths.height - tile.first_row);
  for (std::uint32_t y = 0; y < rows; ++y) {
    const std::size_t row = tile.first_row + y;
    std::copy_n(tile.depths.row(y), columns, image.depths.row(row) + tile.first_column);
    std::copy_n(tile.numbers.row(y), columns, image.numbers.row(row) + tile.first_column);
  }
}

/// What a thread draws with.
struct TileWorker {
  explicit TileWorker(std::uint32_t side) : tile(side, side) {}
  DepthImage tile;
  std::uint64_t drawn = 0;
};

}  // namespace

TileCounts draw_in_tiles(std::span<const EdgeSetup> setups, std::uint32_t side, int threads,
                         DepthImage& image) {
  const TileGrid grid{side, (image.depths.width + side - 1) / side,
                      (image.depths.height + side - 1) / side};
  const Bins bins(setups, grid);
  const std::size_t tiles = bins.starts.size() - 1;
  PerThread<TileWorker> workers([&] { return TileWorker(side); });
  with_threads(threads, [&] {
    parallel_for(std::size_t{0}, tiles, [&](std::size_t number) {
      TileWorker& worker = workers.local();
      worker.tile.clear(static_cast<std::uint32_t>(number) % grid.columns * side,
                        static_cast<std::uint32_t>(number) / grid.columns * side);
      draw_nearest(setups, bins.in_tile(number), worker.tile);
      copy(worker.tile, image);
      ++worker.drawn;
    });
  });
  TileCounts count{tiles, bins.sorted.size(), 0};
  workers.for_each([&](const TileWorker& worker) {
    count.most_of_a_thread = std::max(count.most_of_a_thread, worker.drawn);
  });
  return count;
}

}  // namespace fathom::bench
