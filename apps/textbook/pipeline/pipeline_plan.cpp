#include "apps/textbook/pipeline/pipeline_plan.h"

#include "apps/options/map_arguments.h"
#include "fathom/failures/errors.h"
#include "fathom/render_by_pipeline.h"

namespace fathom::app {
namespace {

/// Refuses what only an exact engine can do.
void check_possible(const RenderArguments& a, MapFormat format) {
  if (a.stream) throw UsageError("--stream is for the fast engine, not for pipeline");
  if (a.verified_pixels) {
    throw UsageError("--verify is for exact engines; fathom compare shows how two maps differ");
  }
  if (a.deep || !a.mattes().empty()) {
    throw UsageError("--deep and --cryptomatte are for exact engines, not for pipeline");
  }
  if (a.samples || a.depth_buffer.against_exact) {
    throw UsageError("--samples and --against-exact are for exact engines, not for pipeline");
  }
  if (format == MapFormat::png) {
    throw UsageError(
        "the pipeline writes its map as .exr, .pfm, .npy, .npz, .bin or .tif; --image is for the "
        "picture");
  }
  if (a.storage.encoding_for(format).type != DepthEncoding::Type::binary32) {
    throw UsageError("--dtype: the pipeline's depths are float32");
  }
}

pipeline::PipelineOptions stages_of(const RenderArguments& a) {
  pipeline::PipelineOptions stages = a.pipeline.options(a.cull);
  DepthFormat& format = stages.depth_format;
  format.storage = a.depth_buffer.storage.value_or(format.storage);
  format.mapping = a.depth_buffer.mapping.value_or(format.mapping);
  format.c = a.depth_buffer.c.value_or(format.c);
  pipeline::require_meaningful(stages);
  return stages;
}

/// The shutter, with what takes pictures while it is open; neither makes sense without the other.
std::optional<pipeline::Shutter> shutter_of(const RenderArguments& a,
                                            const pipeline::PipelineOptions& stages) {
  using pipeline::AntialiasMethod;
  const AntialiasMethod method = stages.antialias.method;
  const bool averaged =
      method == AntialiasMethod::temporal || method == AntialiasMethod::temporal_area;
  if (averaged && !(a.shutter && a.motion.is_given())) {
    throw UsageError("--antialias temporal:N and temporal-area:N need --motion and --shutter");
  }
  if (!a.shutter) return std::nullopt;
  if (!a.motion.is_given()) throw UsageError("--shutter needs --motion: nothing moves without it");
  if (a.motion.time) {
    throw UsageError("--shutter OPEN,CLOSE says the times; --time is for pictures without it");
  }
  if (!averaged && method != AntialiasMethod::taa) {
    throw UsageError("--shutter is for --antialias temporal:N, temporal-area:N and taa:N");
  }
  return pipeline::Shutter{(*a.shutter)[0], (*a.shutter)[1]};
}

}  // namespace

PipelinePlan plan_pipeline(const RenderArguments& a) {
  PipelinePlan plan;
  plan.format = a.storage.format_of(a.output);
  check_possible(a, plan.format);
  plan.channels = a.channels.value_or(std::vector{Channel::Z});
  if (!holds_all_channels(plan.format) && plan.channels.size() != 1) {
    throw UsageError(a.output + " holds one channel, not '" + text_of(plan.channels) +
                     "'; .exr and .npz hold them all");
  }
  require_pipeline_channels(plan.channels);
  plan.writing = a.storage.write_options(a.scene.threads);
  plan.storage = a.storage;
  plan.stages = stages_of(a);
  plan.with_picture = !a.image.empty();
  if (a.depth_buffer.storage && plan.stages.hidden_surface == pipeline::HiddenSurface::painter) {
    throw UsageError("--depth-format: the painter's algorithm has no depth buffer");
  }
  plan.with_depth_buffer = a.depth_buffer.storage && holds_all_channels(plan.format);
  if (plan.with_depth_buffer && plan.stages.depth_range[0] == plan.stages.depth_range[1]) {
    throw UsageError(
        "--depth-range: near and far have the same window depth, of which --depth-format cannot "
        "decode one");
  }
  plan.shutter = shutter_of(a, plan.stages);
  return plan;
}

}  // namespace fathom::app
