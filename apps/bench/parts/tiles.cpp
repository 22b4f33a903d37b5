#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "apps/bench/parts/edge_kernels.h"
#include "apps/bench/parts/ideas.h"
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

Picture picture_of(const DepthImage& image) {
  Picture picture = image.depths.picture();
  const Picture numbers = image.numbers.picture();
  picture.insert(picture.end(), numbers.begin(), numbers.end());
  return picture;
}

double kilobytes(const DepthImage& image) {
  return static_cast<double>((image.depths.numbers.size() + image.numbers.numbers.size()) *
                             sizeof(double)) /
         1024;
}

constexpr std::uint32_t side_for_threads = 64;

std::string threads_name(const char* what, int count) {
  return fmt::format("{}, {} thread{}", what, count, count == 1 ? "" : "s");
}

Variant by_tiles(const PartsScene& scene, const std::shared_ptr<DepthImage>& image, int threads) {
  const auto counted = std::make_shared<TileCounts>();
  return {.name = threads_name("tiles of 64x64", threads),
          .prepare = [image] { image->clear(0, 0); },
          .draw =
              [image, &scene, threads, counted] {
                *counted = draw_in_tiles(scene.setups, side_for_threads, threads, *image);
              },
          .picture = [image] { return image->depths.picture(); },
          .counts = [counted]() -> Counts {
            return {{"tiles", static_cast<double>(counted->tiles)},
                    {"most of a thread", static_cast<double>(counted->most_of_a_thread)}};
          }};
}

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

std::vector<Idea> tiles(const PartsScene& scene) {
  Idea idea{"tiles", {}, "8 lanes of binary64, one thread; a z-buffer of 16 bytes a pixel"};
  const auto expected = std::make_shared<const Picture>(exact_nearest(scene.window));
  const auto image = std::make_shared<DepthImage>(scene.window.width, scene.window.height);
  idea.variants.push_back({.name = "whole image",
                           .draw =
                               [image, &scene] {
                                 image->clear(0, 0);
                                 draw_nearest(scene.setups, *image);
                               },
                           .picture = [image] { return picture_of(*image); },
                           .counts = [image, &scene]() -> Counts {
                             return {
                                 {"tiles", 1},
                                 {"triangles x tiles", static_cast<double>(scene.setups.size())},
                                 {"KiB of a z-buffer", kilobytes(*image)}};
                           },
                           .expected = expected});
  for (const std::uint32_t side : {16U, 32U, 64U, 128U, 256U}) {
    const auto counted = std::make_shared<TileCounts>();
    idea.variants.push_back(
        {.name = fmt::format("tiles of {0}x{0}", side),
         .prepare = [image] { image->clear(0, 0); },
         .draw = [image, &scene, side,
                  counted] { *counted = draw_in_tiles(scene.setups, side, 1, *image); },
         .picture = [image] { return picture_of(*image); },
         .counts = [counted, side]() -> Counts {
           return {{"tiles", static_cast<double>(counted->tiles)},
                   {"triangles x tiles", static_cast<double>(counted->pairs)},
                   {"KiB of a z-buffer", kilobytes(DepthImage(side, side))}};
         },
         .expected = expected});
  }
  return {std::move(idea)};
}

std::vector<Idea> threads(const PartsScene& scene, const std::vector<int>& counts) {
  Idea idea{"threads", {}, "with tiles, one thread sorts the triangles into them"};
  const auto image = std::make_shared<DepthImage>(scene.window.width, scene.window.height);
  std::vector<Variant> tiles, engine;
  for (const int count : counts) {
    tiles.push_back(by_tiles(scene, image, count));
    engine.push_back(fast_variant(threads_name("fast engine", count), scene.bench,
                                  {.threads = count},
                                  [](const RenderStatistics&) { return Counts(); }));
  }
  add_group(idea.variants, std::move(tiles));
  add_group(idea.variants, std::move(engine));
  return {std::move(idea)};
}

}  // namespace fathom::bench
