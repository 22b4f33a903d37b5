#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/bench/parts/engine_variants.h"
#include "apps/bench/parts/ideas.h"
#include "fathom/pipeline/geometry/geometry_stages.h"
#include "fathom/pipeline/geometry/vertex_transform.h"
#include "fathom/pipeline/geometry/window_triangle.h"

namespace fathom::bench {
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

/// Of every order with the test after shading and before it: the depths have to be those of the
/// first, and the colours of the two those of each other. (Equally near surfaces of different
/// colours are the only ones whose order shows.)
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

/// The scene with its triangles in the pipeline's order, those that it does not draw last; nothing
/// for a scene of several objects, which are drawn one after another.
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

/// The fast engine leaves out blocks of 8 × 8 samples that are behind all that is drawn in them.
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

}  // namespace fathom::bench
