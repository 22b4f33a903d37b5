#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/bench/parts/edge_kernels.h"
#include "apps/bench/parts/engine_variants.h"
#include "apps/bench/parts/ideas.h"

namespace fathom::bench {
namespace {

double pixels_in_boxes(const std::vector<EdgeSetup>& setups) {
  double pixels = 0;
  for (const EdgeSetup& s : setups) pixels += static_cast<double>(s.columns) * s.rows;
  return pixels;
}

/// The textbook's loop with `lanes`: without blocks and with them.
std::vector<Variant> by_the_loop(const PartsScene& scene, int lanes,
                                 const std::shared_ptr<PaddedImage<double>>& layers,
                                 const std::shared_ptr<const Picture>& expected) {
  const auto counted = std::make_shared<BlockCounts>();
  const std::string name = lanes == 1 ? "1 lane" : fmt::format("{} lanes", lanes);
  Variant box{.name = name + ", all of the box",
              .prepare = [layers] { std::fill(layers->numbers.begin(), layers->numbers.end(), 0); },
              .draw =
                  [layers, &scene, lanes] {
                    if (lanes == 1)
                      add_boxes_one_by_one<double>(scene.setups, *layers);
                    else
                      add_boxes<double>(scene.setups, lanes, *layers);
                  },
              .picture = [layers] { return layers->picture(); },
              .counts =
                  [&scene] {
                    return Counts{{"pixels tested", pixels_in_boxes(scene.setups)}};
                  },
              .expected = expected};
  Variant by_blocks = box;
  by_blocks.name = name + ", blocks first";
  by_blocks.draw = [layers, &scene, lanes, counted] {
    *counted = lanes == 1 ? add_blocks_one_by_one(scene.setups, *layers)
                          : add_blocks(scene.setups, *layers);
  };
  by_blocks.counts = [counted] {
    return Counts{{"pixels tested", static_cast<double>(counted->pixels_tested)},
                  {"blocks", static_cast<double>(counted->tested)},
                  {"outside", static_cast<double>(counted->outside)},
                  {"inside", static_cast<double>(counted->inside)}};
  };
  return {std::move(box), std::move(by_blocks)};
}

/// Its statistics count blocks, and fragments; not pixels that are tested and not covered.
std::vector<Variant> by_the_pipeline(const PartsScene& scene) {
  const auto counts = [](const pipeline::PipelineStatistics& s) -> Counts {
    return {{"outside", static_cast<double>(s.blocks_skipped)},
            {"inside", static_cast<double>(s.blocks_full)}};
  };
  pipeline::PipelineOptions options = plain_pipeline();
  options.blocks = false;
  Variant box = pipeline_variant("pipeline, all of the box", scene.bench, options,
                                 [](const pipeline::PipelineStatistics&) { return Counts(); });
  options.blocks = true;
  return {std::move(box), pipeline_variant("pipeline, blocks first", scene.bench, options, counts)};
}

std::vector<Variant> by_the_fast_engine(const PartsScene& scene) {
  const auto counts = [](const RenderStatistics& s) -> Counts {
    return {{"pixels tested", static_cast<double>(s.samples_tested)}};
  };
  RenderOptions options{.threads = 1};
  options.fast.early_rejection = false;
  options.fast.hierarchy = false;
  Variant box = fast_variant("fast engine, all of the box", scene.bench, options, counts);
  options.fast.hierarchy = true;
  return {std::move(box), fast_variant("fast engine, blocks first", scene.bench, options, counts)};
}

}  // namespace

std::vector<Idea> blocks(const PartsScene& scene) {
  Idea idea{"blocks before pixels",
            {},
            "blocks of 8x8; the fast engine counts the pixels of blocks inside too"};
  const auto expected = std::make_shared<const Picture>(exact_layers(scene.window));
  const auto layers =
      std::make_shared<PaddedImage<double>>(scene.window.width, scene.window.height, 0.0);
  for (const int lanes : {1, 8}) {
    std::vector<Variant> group = by_the_loop(scene, lanes, layers, expected);
    const std::size_t plain = idea.variants.size();
    for (Variant& variant : group) {
      variant.plain = plain;
      idea.variants.push_back(std::move(variant));
    }
  }
  add_group(idea.variants, by_the_pipeline(scene));
  add_group(idea.variants, by_the_fast_engine(scene));
  return {std::move(idea)};
}

}  // namespace fathom::bench
