#include <utility>

#include "apps/bench/parts/engine_variants.h"
#include "apps/bench/parts/ideas.h"

namespace fathom::bench {
namespace {

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(whole);
}

/// The share is that of the triangles whose facing is asked for: with an area, in the window.
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
  // Rounded depths of two faces that meet in an outline may come out in either order.
  by_pipeline.back().may_differ = true;

  Idea idea{"culling", {}, ""};
  add_group(idea.variants, std::move(by_pipeline));
  add_group(idea.variants, std::move(engine));
  return {std::move(idea)};
}

}  // namespace fathom::bench
