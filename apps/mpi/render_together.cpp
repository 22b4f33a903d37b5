#include "apps/mpi/render_together.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/mpi/deep_together.h"
#include "apps/mpi/map_together.h"
#include "apps/mpi/run_outputs.h"
#include "apps/mpi/scene_together.h"
#include "apps/mpi/together.h"
#include "apps/render/render_limits.h"
#include "apps/render/render_plan.h"
#include "apps/render/render_report.h"
#include "apps/shell/failures.h"
#include "apps/shell/progress.h"
#include "apps/shell/signals.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

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
  // What was verified, the first rank knows.
  const bool differs = std::ranges::any_of(reports, [](const MapReport& each) {
    return each.verification && !each.verification->agrees();
  });
  return ranks.sum(differs ? 1 : 0) == 0 ? done : answer_is_no;
}

}  // namespace

int render_together(const MpiArguments& arguments, const Console& for_all) {
  const Ranks ranks;
  const RenderArguments& render = arguments.render;
  Console console = for_all;
  console.quiet = console.quiet || !ranks.is_first();

  MapPlan plan;
  together(ranks, [&] {
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
