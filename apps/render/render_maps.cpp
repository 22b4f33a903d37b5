#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "apps/options/scene_options.h"
#include "apps/render/map_additions.h"
#include "apps/render/render_command.h"
#include "apps/render/render_outputs.h"
#include "apps/render/render_plan.h"
#include "apps/render/render_report.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "fathom/camera/camera.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/png_files.h"
#include "fathom/render.h"
#include "fathom/rendering/options.h"
#include "fathom/scene/triangle_source.h"

namespace fathom::app {
namespace {

/// The rendered scene: in memory, or streamed from its files.
class RenderInput {
 public:
  enum class Place { memory, files };

  /// Data that channels need from the files in addition to positions.
  struct Kept {
    /// Materials, groups, parts and labels.
    bool segments = false;
    bool normals = false;
  };

  RenderInput(const SceneOptions& options, Place place, const Kept& kept, const Console& console);

  /// The scene; for a streamed scene only its bounds, objects and sources, from which cameras are
  /// made.
  [[nodiscard]] const Scene& outline() const { return scene_; }
  /// Places the objects that move.
  /// Fails    UsageError where the scene stays in its files; as MotionOptions::placed.
  void place(const MotionOptions& motion);
  [[nodiscard]] TriangleSource triangles() const;
  [[nodiscard]] Rendered render(const Camera& camera, const RenderOptions& options,
                                const RenderContext& context) const;

 private:
  Scene scene_;
  std::optional<StreamedScene> streamed_;
};

StreamedScene stream(const SceneOptions& options, bool segments, const Console& console) {
  const std::vector<std::string>& files = options.files;
  if (std::count(files.begin(), files.end(), "-") > 0) {
    throw UsageError("--stream: '-', standard input, cannot be read in parts; expected files");
  }
  Warnings warnings;
  ReadOptions reading = options.read_options();
  reading.segments = segments;
  StreamedScene scene = stream_scene({files.begin(), files.end()}, reading, warnings);
  console.warn(warnings);
  for (const std::string& file : files) note_input(file);
  return scene;
}

RenderInput::RenderInput(const SceneOptions& options, Place place, const Kept& kept,
                         const Console& console) {
  if (place == Place::files) {
    streamed_ = stream(options, kept.segments, console);
    scene_ = outline_of(*streamed_);
  } else {
    scene_ = options.read(console,
                          {.hash = true, .attributes = kept.normals, .segments = kept.segments});
  }
}

void RenderInput::place(const MotionOptions& motion) {
  if (streamed_ && motion.is_given()) {
    throw UsageError("--motion needs the scene in memory, without --stream");
  }
  scene_ = motion.placed(std::move(scene_));
}

TriangleSource RenderInput::triangles() const {
  return streamed_ ? TriangleSource(*streamed_) : TriangleSource(scene_);
}

Rendered RenderInput::render(const Camera& camera, const RenderOptions& options,
                             const RenderContext& context) const {
  return streamed_
             ? fathom::render(*streamed_, camera, options, stream_limits(camera, options), context)
             : fathom::render(scene_, camera, options, context);
}

/// The channels of the first of these outputs, taken from the map of their pass. A channel that a
/// later output has too is copied, any other is moved.
std::vector<ImageChannel> take_channels(DepthMap& map, std::span<const OutputPlan> outputs,
                                        const Camera& camera) {
  std::vector<ImageChannel> channels;
  for (const Channel channel : outputs.front().plan.rendering_for(camera).channels) {
    const bool is_needed_later = std::ranges::any_of(outputs.subspan(1), [&](const auto& later) {
      return std::ranges::count(later.plan.rendering_for(camera).channels, channel) > 0;
    });
    for (const std::string& name : part_names(channel)) {
      ImageChannel& found = *map.find(name);
      channels.push_back(is_needed_later ? found : std::move(found));
    }
  }
  return channels;
}

/// The map of the first of these outputs as a rendering of its own would make it: its channels, and
/// the scale, counts, names and texts that belong to them.
DepthMap part_for(DepthMap& map, std::span<const OutputPlan> outputs, const Scene& scene,
                  const Camera& camera, const RenderStatistics& statistics) {
  const RenderOptions options = outputs.front().plan.rendering_for(camera);
  DepthMap part;
  part.width = map.width;
  part.height = map.height;
  part.channels = take_channels(map, outputs, camera);
  if (options.depth_encoding.type == DepthEncoding::Type::scaled_unorm16) {
    part.png_scale = map.png_scale;
  }
  finish_map(part, scene, camera, options, statistics);
  return part;
}

/// Writes the file of an output, and the description of its codes if requested.
void write_output(const OutputPlan& output, DepthMap map, RenderOutputs& outputs,
                  std::size_t camera, const Console& console) {
  const std::string& name = outputs.map_name(camera, output.number);
  const MapPlan& plan = output.plan;
  map = plan.storage.dressed(std::move(map), name, std::numeric_limits<double>::infinity());
  outputs.map(camera, output.number).write(encode_planned(map, plan, name));
  if (plan.storage.png_sidecar) outputs.sidecar(camera, output.number).write(png_sidecar(map));
  warn_of_codes_beyond(map, name, console);
}

/// Makes the map of a camera, checks it if requested, and writes the files of the pass.
MapReport make_map(const RenderPass& pass, const RenderInput& scene, const MotionOptions& motion,
                   const Camera& camera, RenderOutputs& outputs, std::size_t number,
                   const RenderContext& context, const Console& console) {
  const MapPlan& plan = pass.plan;
  const std::string& name = outputs.map_name(number, pass.outputs.front().number);
  MapReport report{.map = name, .engine = plan.rendering.engine};
  const RenderOptions options = pass.rendering_for(camera);
  Stopwatch stopwatch;
  // The message about a depth that the file cannot hold names the map.
  Rendered rendered = about_output(name, [&] { return scene.render(camera, options, context); });
  DepthMap map = std::move(rendered.map);
  report.statistics = rendered.statistics;
  motion.describe(map, motion.time_or_start());
  report.width = map.width;
  report.height = map.height;
  report.seconds.render = stopwatch.lap();
  const auto render_again = [&](const RenderOptions& other) {
    return scene.render(camera, other, {.kept = context.kept});
  };
  const auto mattes = [&](const MatteKind& by) {
    return find_mattes(scene.outline(), camera, options, by, {}, context.progress);
  };
  add_planned(map, plan, name, {scene.triangles(), camera, options, render_again, mattes}, report,
              console);
  stopwatch.lap();
  if (pass.outputs.size() == 1) {
    write_output(pass.outputs.front(), std::move(map), outputs, number, console);
  } else {
    for (std::span<const OutputPlan> left = pass.outputs; !left.empty(); left = left.subspan(1)) {
      DepthMap part = part_for(map, left, scene.outline(), camera, report.statistics);
      motion.describe(part, motion.time_or_start());
      write_output(left.front(), std::move(part), outputs, number, console);
    }
  }
  report.seconds.write = stopwatch.lap();
  return report;
}

/// Channels of all passes, each once.
std::vector<Channel> channels_of(const std::vector<RenderPass>& passes) {
  std::vector<Channel> channels;
  for (const RenderPass& pass : passes) {
    for (const Channel channel : pass.plan.rendering.channels) {
      if (std::ranges::count(channels, channel) == 0) channels.push_back(channel);
    }
  }
  return channels;
}

void check_passes(const std::vector<Camera>& cameras, const std::vector<RenderPass>& passes,
                  const std::vector<std::string>& patterns) {
  for (const RenderPass& pass : passes) {
    check_cameras(cameras, pass.plan, patterns[pass.outputs.front().number]);
    if (pass.outputs.size() == 1) continue;
    for (const OutputPlan& output : pass.outputs) {
      check_cameras(cameras, output.plan, patterns[output.number]);
    }
  }
}

/// The hint for the first output that has one.
std::string hint_of(const std::vector<RenderPass>& passes, const Camera& camera,
                    const RenderOutputs& outputs) {
  for (const RenderPass& pass : passes) {
    for (const OutputPlan& output : pass.outputs) {
      if (std::string hint = hint_for_lens(camera, output.plan); !hint.empty()) return hint;
      const std::string& name = outputs.map_name(0, output.number);
      if (std::string hint = hint_for_first_exr(name, output.plan); !hint.empty()) return hint;
    }
  }
  return "";
}

int render_maps(RenderArguments arguments, const Console& console) {
  std::vector<RenderPass> passes = plan_passes(arguments);
  const ThreadLimit limit(passes.front().plan.rendering.threads);
  Stopwatch stopwatch;
  const auto place = arguments.stream ? RenderInput::Place::files : RenderInput::Place::memory;
  const auto any = [&](const auto& needs) {
    return std::ranges::any_of(passes, [&](const RenderPass& pass) { return needs(pass.plan); });
  };
  RenderInput scene(arguments.scene, place,
                    {.segments = any([](const MapPlan& plan) { return plan.needs_segments(); }),
                     .normals = any([](const MapPlan& plan) { return plan.needs_normals(); })},
                    console);
  const double seconds_reading = stopwatch.lap();
  arguments.outputs = with_objects(arguments.outputs, scene.outline().objects.size());
  passes = plan_passes(arguments);
  const std::vector<Camera> cameras =
      arguments.camera.get(scene.outline(), arguments.scene.limits, console);
  scene.place(arguments.motion);
  warn_of_missing_segments(scene.triangles(), channels_of(passes), console);
  check_passes(cameras, passes, arguments.patterns());
  RenderOutputs outputs(arguments, cameras);
  outputs.write_cameras(to_json(cameras) + "\n");
  const std::string hint =
      console.shows_progress() ? hint_of(passes, cameras.front(), outputs) : "";

  RenderMemory memory;
  // Files are read to keep memory small.
  const std::size_t maps = cameras.size() * passes.size();
  RenderMemory* const kept = maps > 1 && !arguments.stream ? &memory : nullptr;
  std::vector<MapReport> reports;
  bool all_agree = true;
  CameraWarnings warnings;
  {
    Progress progress(console, "rendering");
    for (std::size_t k = 0; k < maps; ++k) {
      const std::size_t i = k / passes.size(), pass = k % passes.size();
      reports.push_back(make_map(passes[pass], scene, arguments.motion, cameras[i], outputs, i,
                                 {.kept = kept, .progress = progress.reporter(k, maps)}, console));
      MapReport& report = reports.back();
      report.seconds.read = seconds_reading;
      all_agree = all_agree && (!report.verification || report.verification->agrees());
      if (pass != 0) continue;
      if (i == 0) warn_of(report.statistics, console);
      warnings.note(scene.outline(), cameras[i], report.statistics.pixels_with_surface);
    }
  }
  warnings.tell(console);
  outputs.write_statistics(as_json(reports));
  outputs.commit();
  if (!hint.empty()) console.note(hint);
  return all_agree ? done : answer_is_no;
}

int render_deep_maps(const RenderArguments& arguments, const DeepMapPlan& plan,
                     const Console& console) {
  const RenderOptions& options = plan.rendering;
  const ThreadLimit limit(options.threads);
  Scene scene = arguments.scene.read(console, {.hash = true});
  const std::vector<Camera> cameras = arguments.camera.get(scene, arguments.scene.limits, console);
  scene = arguments.motion.placed(std::move(scene));
  check_cameras(cameras, plan, arguments.output);
  RenderOutputs outputs(arguments, cameras);
  outputs.write_cameras(to_json(cameras) + "\n");
  CameraWarnings warnings;
  {
    Progress progress(console, "rendering");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      DeepMap map =
          render_deep(scene, cameras[i], options, {}, progress.reporter(i, cameras.size()));
      arguments.motion.describe(map.description, arguments.motion.time_or_start());
      outputs.map(i).write(
          [&](const auto& path) { write_deep_map(map, path, plan.compression, options.threads); });
      warnings.note(scene, cameras[i], map);
    }
  }
  warnings.tell(console);
  outputs.commit();
  return done;
}

}  // namespace

int render_exactly(const RenderArguments& arguments, const Console& console) {
  if (arguments.deep && arguments.patterns().size() > 1) {
    throw UsageError("--deep is for a single -o");
  }
  return arguments.deep ? render_deep_maps(arguments, plan_deep_maps(arguments), console)
                        : render_maps(arguments, console);
}

}  // namespace fathom::app
