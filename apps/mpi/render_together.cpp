#include "apps/mpi/render_together.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/mpi/image_rows.h"
#include "apps/mpi/ranks.h"
#include "apps/mpi/together.h"
#include "apps/mpi/traffic.h"
#include "apps/render/render_limits.h"
#include "apps/render/render_outputs.h"
#include "apps/render/render_plan.h"
#include "apps/render/render_report.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/last_resort.h"
#include "apps/shell/output_file.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/image/deep_map.h"
#include "fathom/render.h"

namespace fathom::app {
namespace {

/// Outputs of a run, all written by its first rank: the outputs of a single process, and the
/// traffic between ranks.
class RunOutputs {
 public:
  /// Writes the cameras.
  /// Fails    as RenderOutputs and TextOutput.
  RunOutputs(const MpiArguments& arguments, const std::vector<Camera>& cameras);

  [[nodiscard]] RenderOutputs& of_render() { return of_render_; }

  /// Puts all of them in their places. `traffic`: of all maps.
  void commit(const std::vector<MapTraffic>& traffic, int ranks);

 private:
  TextOutput traffic_;
  RenderOutputs of_render_;
};

RunOutputs::RunOutputs(const MpiArguments& arguments, const std::vector<Camera>& cameras)
    : traffic_(arguments.traffic), of_render_(arguments.render, cameras) {
  of_render_.write_cameras(to_json(cameras) + "\n");
}

void RunOutputs::commit(const std::vector<MapTraffic>& traffic, int ranks) {
  of_render_.commit();
  traffic_.finish(as_json(traffic, ranks));
}

/// In the first rank, with the samples of all.
DeepMap make_deep_map(const Ranks& ranks, const Scene& scene, const Camera& camera,
                      const RenderOptions& options, const std::function<void(double)>& progress,
                      MapTraffic& traffic) {
  DeepMap map;
  Stopwatch stopwatch;
  together(ranks, [&] { map = render_deep(scene, camera, options, share_of(ranks), progress); });
  traffic.drawing = stopwatch.lap();
  gather_rows(ranks, camera.width, map.counts, map.samples, traffic.of_pixels);
  return map;
}

/// `fathom-mpi render --deep`: every rank has the whole scene and makes a share of the rows, and
/// the first writes what all have made. Called by all ranks. Returns the exit status.
int render_deep_together(const Ranks& ranks, const MpiArguments& arguments,
                         const Console& console) {
  const RenderArguments& render = arguments.render;
  DeepMapPlan plan;
  together(ranks, [&] { plan = plan_deep_maps(render); });
  const ThreadLimit limit(plan.rendering.threads);
  SharedScene shared =
      open_scene(ranks, render, {.whole = true, .hash = ranks.is_first()}, console);
  const std::vector<Camera> cameras = cameras_of(ranks, render, {}, shared, console);
  const Scene& scene = shared.outline();
  std::optional<RunOutputs> outputs;  // in the first rank
  together(ranks, [&] {
    check_cameras(cameras, plan, render.output);
    if (ranks.is_first()) outputs.emplace(arguments, cameras);
  });
  CameraWarnings warnings;
  std::vector<MapTraffic> traffic(cameras.size());
  {
    Progress progress(console, "rendering");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      traffic[i].triangles = traffic[i].drawn = shared.first_numbers().back();
      traffic[i].most_drawn = traffic[i].drawn;
      DeepMap map = make_deep_map(ranks, scene, cameras[i], plan.rendering,
                                  progress.reporter(i, cameras.size()), traffic[i]);
      sum_up(traffic[i], ranks);
      together(ranks, [&] {
        if (!outputs) return;
        traffic[i].map = outputs->of_render().map_name(i);
        render.motion.describe(map.description, render.motion.time_or_start());
        outputs->of_render().map(i).write([&](const auto& path) {
          write_deep_map(map, path, plan.compression, plan.rendering.threads);
        });
        warnings.note(scene, cameras[i], map);
      });
    }
  }
  warnings.tell(console);
  together(ranks, [&] {
    if (outputs) outputs->commit(traffic, ranks.count());
  });
  say_when_interrupted("");
  return done;
}

RankMemory memory_for(const Ranks& ranks, const MpiArguments& arguments, const MapPlan& plan) {
  const bool by_area = std::ranges::count(plan.rendering.channels, Channel::A) != 0;
  return memory_of_rank(ranks, arguments.memory, by_area);
}

SharedScene::Kept kept_for(const Ranks& ranks, const RenderArguments& arguments,
                           const MapPlan& plan) {
  return {.whole = arguments.motion.is_given() || !plan.mattes.empty(),
          .segments = plan.needs_segments(),
          .normals = std::ranges::count(plan.rendering.channels, Channel::Ns) != 0,
          .hash = ranks.is_first()};
}

/// Returns the exit status.
int render_maps(const JobTogether& job, const std::vector<Camera>& cameras,
                double seconds_reading) {
  const Ranks& ranks = job.ranks;
  const RenderArguments& arguments = job.arguments.render;
  std::optional<RunOutputs> outputs;  // in the first rank
  together(ranks, [&] {
    check_cameras(cameras, job.plan, arguments.output, rows_of_chunk(job.plan).has_value());
    if (ranks.is_first()) outputs.emplace(job.arguments, cameras);
  });
  keep_what_rounds_give_back();
  std::vector<MapTraffic> traffic(cameras.size());
  std::vector<MapReport> reports(cameras.size());
  CameraWarnings warnings;
  {
    Progress progress(job.console, "rendering");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      make_map_together(job, cameras[i], outputs ? &outputs->of_render() : nullptr, i,
                        progress.reporter(i, cameras.size()), traffic[i], reports[i]);
      reports[i].seconds.read = seconds_reading;
      const RenderStatistics& statistics = reports[i].statistics;
      if (i == 0) warn_of(statistics, job.console);
      warnings.note(job.scene.outline(), cameras[i], statistics.pixels_with_surface);
    }
  }
  warnings.tell(job.console);
  together(ranks, [&] {
    if (!outputs) return;
    outputs->of_render().write_statistics(as_json(reports));
    outputs->commit(traffic, ranks.count());
  });
  // Only the first rank has the result of the verification.
  const bool differs = std::ranges::any_of(reports, [](const MapReport& each) {
    return each.verification && !each.verification->agrees();
  });
  return ranks.sum(differs ? 1 : 0) == 0 ? done : answer_is_no;
}

}  // namespace

int render_together(const MpiArguments& given, const Console& for_all) {
  const Ranks ranks;
  MpiArguments arguments = given;
  const RenderArguments& render = arguments.render;
  Console console = for_all;
  console.quiet = console.quiet || !ranks.is_first();

  MapPlan plan;
  together(ranks, [&] {
    arguments.render = given.render.of_only_output("fathom-mpi");
    refuse_what_is_missing(render);
    if (!render.deep) plan = plan_maps(render);
  });
  if (render.deep) return render_deep_together(ranks, arguments, console);
  const ThreadLimit limit(plan.rendering.threads);
  const RankMemory memory = memory_for(ranks, arguments, plan);
  Stopwatch stopwatch;
  SharedScene scene = open_scene(ranks, render, kept_for(ranks, render, plan), console);
  scene.find_bounds(ranks, memory.triangles_at_once);
  const std::vector<Camera> cameras =
      cameras_of(ranks, render, plan.rendering.channels, scene, console);
  const int status =
      render_maps({arguments, ranks, console, plan, scene, memory}, cameras, stopwatch.lap());
  say_when_interrupted("");
  return status;
}

int render_scene_together(const MpiArguments& arguments, const SharedScene& scene,
                          const std::vector<Camera>& cameras, const Console& for_all) {
  const Ranks ranks;
  Console console = for_all;
  console.quiet = console.quiet || !ranks.is_first();
  MapPlan plan;
  together(ranks, [&] { plan = plan_maps(arguments.render); });
  const ThreadLimit limit(plan.rendering.threads);
  const RankMemory memory = memory_for(ranks, arguments, plan);
  return render_maps({arguments, ranks, console, plan, scene, memory}, cameras, 0);
}

}  // namespace fathom::app
