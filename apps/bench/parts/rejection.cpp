#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/bench/parts/edge_kernels.h"
#include "apps/bench/parts/ideas.h"
#include "fathom/pipeline/geometry/geometry_stages.h"
#include "fathom/pipeline/geometry/vertex_transform.h"
#include "fathom/pipeline/geometry/window_triangle.h"

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

/// The pipeline's statistics count blocks and fragments, but not pixels that are tested and not
/// covered.
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

namespace {

using pipeline::DrawOrder;

struct NamedOrder {
  DrawOrder order;
  const char* name;
};
constexpr NamedOrder orders[] = {{DrawOrder::random, "random"},
                                 {DrawOrder::back_to_front, "back to front"},
                                 {DrawOrder::front_to_back, "front to back"}};

Counts fragment_counts(const pipeline::PipelineStatistics& s) {
  return {{"fragments", static_cast<double>(s.fragments)},
          {"fail the test", static_cast<double>(s.fragments - s.depth_passed)},
          {"written", static_cast<double>(s.depth_passed)},
          {"shaded", static_cast<double>(s.shaded)}};
}

/// For every order, the test after shading and the test before it. All depths must equal the depths
/// of the first variant, and the two pictures of an order must have equal colours. (Only equally
/// near surfaces of different colours can show the order.)
Idea by_fragments(const PartsScene& scene) {
  Idea idea{"early rejection, pipeline", {}, "Phong's shading; the time contains sorting"};
  std::shared_ptr<const Picture> first;
  const std::size_t pixels = std::size_t{scene.window.width} * scene.window.height;
  for (const auto& [order, name] : orders) {
    pipeline::PipelineOptions options;
    options.shading = pipeline::Shading::phong;
    options.draw_order = order;
    options.early_depth = false;
    std::vector<Variant> group{pipeline_variant(fmt::format("{}, shaded first", name), scene.bench,
                                                options, fragment_counts)};
    options.early_depth = true;
    group.push_back(pipeline_variant(fmt::format("{}, tested first", name), scene.bench, options,
                                     fragment_counts));
    Picture expected = *picture_of(group[0]);
    if (first)
      std::copy_n(first->begin(), pixels, expected.begin());
    else
      first = std::make_shared<const Picture>(expected);
    const auto shared = std::make_shared<const Picture>(std::move(expected));
    for (Variant& variant : group) {
      variant.expected = shared;
      idea.variants.push_back(std::move(variant));
    }
  }
  return idea;
}

/// The scene with its triangles in the pipeline's order, and at the end the triangles that it does
/// not draw; nullopt for a scene of several objects, which are drawn one after another.
std::optional<BenchScene> in_order(const BenchScene& bench, DrawOrder order) {
  if (bench.scene.objects.size() != 1 || bench.scene.meshes.size() != 1) return std::nullopt;
  pipeline::PipelineOptions options = plain_pipeline();
  options.precision = pipeline::Precision::binary64;
  options.draw_order = order;
  pipeline::fill_in_range(bench.scene, bench.camera, options.depth_format);
  pipeline::PipelineStatistics statistics;
  auto drawn =
      pipeline::to_window<double>(bench.scene, bench.camera, options,
                                  pipeline::draw_rules_of(bench.scene, options), statistics)
          .triangles;
  put_into_draw_order(drawn, options);
  const MeshArray<CornerIndices>& triangles = bench.scene.meshes[0].triangles;
  std::vector<bool> taken(triangles.size());
  std::vector<CornerIndices> sorted;
  const auto take = [&](std::size_t i) {
    if (!taken[i]) sorted.push_back(triangles[i]);
    taken[i] = true;
  };
  for (const auto& triangle : drawn) take(triangle.number);
  for (std::size_t i = 0; i < triangles.size(); ++i) take(i);
  BenchScene result{bench.name, {}, bench.camera};
  result.scene.objects = bench.scene.objects;
  Mesh& mesh = result.scene.meshes.emplace_back();
  mesh.vertices = bench.scene.meshes[0].vertices;
  mesh.triangles = std::move(sorted);
  mesh.face_count = mesh.triangles.size();
  return result;
}

/// The fast engine leaves out blocks of 8 × 8 samples in which a triangle is behind everything
/// already drawn.
std::optional<Idea> by_blocks_behind(const PartsScene& scene) {
  Idea idea{"early rejection, fast engine", {}, "one thread; sorting is not timed"};
  std::vector<Variant> group;
  for (const auto& [order, name] : orders) {
    std::optional<BenchScene> sorted = in_order(scene.bench, order);
    if (!sorted) return std::nullopt;
    const auto bench = std::make_shared<const BenchScene>(std::move(*sorted));
    for (const bool early : {false, true}) {
      RenderOptions options{.threads = 1};
      options.fast.early_rejection = early;
      // The counts keep the scene.
      group.push_back(fast_variant(
          fmt::format("{}, {}", name, early ? "blocks behind left out" : "every block drawn"),
          *bench, options, [bench](const RenderStatistics& s) -> Counts {
            return {{"samples tested", static_cast<double>(s.samples_tested)},
                    {"written", static_cast<double>(s.samples_covered)}};
          }));
    }
  }
  add_group(idea.variants, std::move(group));
  return idea;
}

}  // namespace

std::vector<Idea> early_rejection(const PartsScene& scene) {
  std::vector<Idea> ideas{by_fragments(scene)};
  if (auto idea = by_blocks_behind(scene)) ideas.push_back(std::move(*idea));
  return ideas;
}

namespace {

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

/// The share refers to the triangles whose facing is tested: triangles with an area, in the window.
Counts pipeline_counts(const pipeline::PipelineStatistics& s) {
  return {
      {"culled", static_cast<double>(s.culled)},
      {"culled %", percent(s.culled, s.triangles - s.not_finite - s.clipped_away - s.degenerate)},
      {"fragments", static_cast<double>(s.fragments)},
      {"written", static_cast<double>(s.depth_passed)}};
}

Counts fast_counts(const RenderStatistics& s) {
  return {{"culled", static_cast<double>(s.culled_triangles)},
          {"culled %", percent(s.culled_triangles, s.triangles - s.degenerate_triangles)}};
}

}  // namespace

std::vector<Idea> culling(const PartsScene& scene) {
  RenderOptions fast{.threads = 1};
  std::vector<Variant> engine{
      fast_variant("fast engine, all faces", scene.bench, fast, fast_counts)};
  fast.cull = Cull::back;
  engine.push_back(fast_variant("fast engine, front faces", scene.bench, fast, fast_counts));
  if (*picture_of(engine[0]) != *picture_of(engine[1])) return {};

  pipeline::PipelineOptions options = plain_pipeline();
  std::vector<Variant> by_pipeline{
      pipeline_variant("pipeline, all faces", scene.bench, options, pipeline_counts)};
  options.culling = pipeline::Culling::back;
  by_pipeline.push_back(
      pipeline_variant("pipeline, front faces", scene.bench, options, pipeline_counts));
  // Rounded depths of two faces that meet in an outline may have either order.
  by_pipeline.back().may_differ = true;

  Idea idea{"culling", {}, ""};
  add_group(idea.variants, std::move(by_pipeline));
  add_group(idea.variants, std::move(engine));
  return {std::move(idea)};
}

}  // namespace fathom::bench
