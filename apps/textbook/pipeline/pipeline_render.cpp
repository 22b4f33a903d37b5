#include <fmt/core.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "apps/options/depth_format_options.h"
#include "apps/options/map_arguments.h"
#include "apps/render/render_command.h"
#include "apps/render/render_outputs.h"
#include "apps/shell/console.h"
#include "apps/shell/elapsed_time.h"
#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "apps/textbook/pipeline/pipeline_report.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/image/depth_map.h"
#include "fathom/pipeline/render_moving.h"
#include "fathom/render_by_pipeline.h"
#include "fathom/rendering/segment_channels.h"
#include "fathom/text/counted.h"

namespace fathom::app {
namespace {

/// How the pipeline makes maps and pictures: the combined meaning of the arguments.
struct PipelinePlan {
  MapFormat format = MapFormat::exr;
  WriteOptions writing;
  StorageOptions storage;
  std::vector<Channel> channels;
  pipeline::PipelineOptions stages;
  bool with_picture = false;
  bool with_depth_buffer = false;
  /// The shutter, for a scene that moves while it is open.
  std::optional<pipeline::Shutter> shutter;
};

/// Refuses arguments that only an exact engine supports.
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
  if (!description_of(format).holds_floats) {
    throw UsageError("the pipeline writes its map as " + suffixes_of_float_maps() +
                     "; --image is for the picture");
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

/// The shutter, with the antialiasing that takes pictures while it is open. Each needs the other.
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
    throw UsageError(
        "--shutter OPEN,CLOSE sets the times; --time is for pictures without --shutter");
  }
  if (!averaged && method != AntialiasMethod::taa) {
    throw UsageError("--shutter is for --antialias temporal:N, temporal-area:N and taa:N");
  }
  return pipeline::Shutter{(*a.shutter)[0], (*a.shutter)[1]};
}

/// Fails    UsageError if the arguments contradict each other, before any work.
PipelinePlan plan_pipeline(const RenderArguments& a) {
  PipelinePlan plan;
  plan.format = a.storage.format_of(a.output);
  check_possible(a, plan.format);
  plan.channels = a.channels.value_or(std::vector{Channel::Z});
  if (!holds_all_channels(plan.format) && plan.channels.size() != 1) {
    throw UsageError(a.output + " holds one channel, not '" + text_of(plan.channels) + "'; " +
                     suffixes_of_complete_maps() + " hold them all");
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
        "--depth-range: near and far have the same window depth, from which --depth-format cannot "
        "decode one");
  }
  plan.shutter = shutter_of(a, plan.stages);
  return plan;
}

void warn_of(const pipeline::PipelineStatistics& s, const Console& console) {
  if (s.triangles + s.lines + s.points == 0)
    console.warn("the scene has nothing to draw: the map is background");
  if (s.not_finite > 0) {
    console.warn(fmt::format("{} of {} {} left out: a corner is not finite after the transform",
                             s.not_finite, text::counted(s.triangles, "triangle"),
                             s.not_finite == 1 ? "is" : "are"));
  }
  if (s.turned_by_snapping > 0) {
    console.warn(
        fmt::format("of the {} that clipping leaves, snapping turns {} over or takes their area",
                    text::counted(s.drawn, "triangle"), s.turned_by_snapping));
  }
}

PipelineReport report_of(const std::string& name, const PipelineRendering& rendering,
                         const PipelinePlan& plan) {
  PipelineReport report{name, rendering.map.width, rendering.map.height, rendering.statistics, {}};
  if (plan.stages.hidden_surface == pipeline::HiddenSurface::painter) {
    report.painter = rendering.painter;
  }
  return report;
}

/// Channels, and what they mean.
void add_depth_buffer(PipelineRendering& rendering) {
  const PipelineDepthBuffer& buffer = rendering.depth_buffer;
  fathom::add_depth_buffer(rendering.map, buffer);
  rendering.map.texts[depth_format_text] = json_of(buffer.format).dump();
  const auto& [near, far] = buffer.depth_range;
  if (near != 0 || far != 1) {
    rendering.map.texts[depth_range_text] = fmt::format("[{}, {}]", near, far);
  }
}

/// The scene to draw: at one time, or while the shutter is open.
using Drawn = std::variant<Scene, MovingScene>;

Drawn drawn_from(Scene scene, const PipelinePlan& plan, const RenderArguments& arguments) {
  if (plan.shutter) return arguments.motion.moving(std::move(scene));
  return arguments.motion.placed(std::move(scene));
}

PipelineRendering rendering_of(Drawn& drawn, const Camera& camera, const PipelinePlan& plan) {
  if (auto* moving = std::get_if<MovingScene>(&drawn)) {
    return fathom::render_by_pipeline(*moving, camera, plan.stages, *plan.shutter, plan.channels,
                                      plan.with_picture);
  }
  return fathom::render_by_pipeline(std::get<Scene>(drawn), camera, plan.stages, plan.channels,
                                    plan.with_picture);
}

PipelineRendering timed_rendering_of(Drawn& drawn, const Camera& camera, const PipelinePlan& plan,
                                     const Console& console) {
  const ElapsedTime elapsed(console, "rendering");
  return rendering_of(drawn, camera, plan);
}

int carry_out(const PipelinePlan& plan, const RenderArguments& arguments, const Console& console) {
  if (plan.stages.texture != "checker") note_input(plan.stages.texture);
  Scene scene =
      arguments.scene.read(console, {.hash = true,
                                     .attributes = plan.with_picture,
                                     .primitives = true,
                                     .segments = !segmentations_of(plan.channels).empty()});
  const std::vector<Camera> cameras = arguments.camera.get(scene, arguments.scene.limits, console);
  Drawn drawn = drawn_from(std::move(scene), plan, arguments);
  const double time = plan.shutter ? plan.shutter->close : arguments.motion.time_or_start();
  RenderOutputs outputs(arguments, cameras);
  warn_of_windows(cameras[0], plan.stages, console);

  std::vector<PipelineReport> reports;
  std::vector<Camera> used;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    PipelineRendering rendering = timed_rendering_of(drawn, cameras[i], plan, console);
    arguments.motion.describe(rendering.map, time);
    if (plan.with_depth_buffer) add_depth_buffer(rendering);
    used.push_back(rendering.camera);
    rendering.map = plan.storage.dressed(std::move(rendering.map), outputs.map_name(i),
                                         std::numeric_limits<double>::infinity());
    outputs.map(i).write(
        [&](const auto& path) { write_map(rendering.map, path, plan.format, plan.writing); });
    if (plan.with_picture) {
      outputs.picture(i).write([&](const auto& path) { write_png(rendering.picture, path); });
    }
    if (i == 0) warn_of(rendering.statistics, console);
    reports.push_back(report_of(outputs.map_name(i), rendering, plan));
  }
  outputs.write_cameras(to_json(used) + "\n");
  outputs.write_statistics(as_json(reports));
  outputs.commit();
  return done;
}

}  // namespace

int render_by_pipeline(const RenderArguments& arguments, const Console& console) {
  const RenderArguments only = arguments.of_only_output("--engine pipeline");
  return carry_out(plan_pipeline(only), only, console);
}

}  // namespace fathom::app
