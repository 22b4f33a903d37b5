#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/bench/parts/engine_variants.h"
#include "apps/bench/parts/ideas.h"
#include "apps/bench/parts/tile_drawing.h"

namespace fathom::bench {
namespace {

constexpr std::uint32_t side = 64;

std::string threads_name(const char* what, int count) {
  return fmt::format("{}, {} thread{}", what, count, count == 1 ? "" : "s");
}

Variant by_tiles(const PartsScene& scene, const std::shared_ptr<DepthImage>& image, int threads) {
  const auto counted = std::make_shared<TileCounts>();
  return {.name = threads_name("tiles of 64x64", threads),
          .prepare = [image] { image->clear(0, 0); },
          .draw = [image, &scene, threads,
                   counted] { *counted = draw_in_tiles(scene.setups, side, threads, *image); },
          .picture = [image] { return image->depths.picture(); },
          .counts = [counted]() -> Counts {
            return {{"tiles", static_cast<double>(counted->tiles)},
                    {"most of a thread", static_cast<double>(counted->most_of_a_thread)}};
          }};
}

}  // namespace

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
