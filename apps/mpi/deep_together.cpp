#include "apps/mpi/deep_together.h"

#include <optional>
#include <vector>

#include "apps/mpi/gathered_rows.h"
#include "apps/mpi/run_outputs.h"
#include "apps/mpi/scene_together.h"
#include "apps/mpi/together.h"
#include "apps/mpi/traffic.h"
#include "apps/render/render_limits.h"
#include "apps/render/render_plan.h"
#include "apps/render/render_report.h"
#include "apps/shell/failures.h"
#include "apps/shell/progress.h"
#include "apps/shell/signals.h"
#include "fathom/image/deep_map.h"
#include "fathom/render.h"

namespace fathom::app {
namespace {

/// In the first rank, with the samples of all.
DeepMap make_deep_map(const Ranks& ranks, const Scene& scene, const Camera& camera,
                      const RenderOptions& options, MapTraffic& traffic) {
  DeepMap map;
  Stopwatch stopwatch;
  together(ranks, [&] { map = render_deep(scene, camera, options, share_of(ranks)); });
  traffic.drawing = stopwatch.lap();
  gather_rows(ranks, camera.width, map.counts, map.samples, traffic.of_pixels);
  return map;
}

}  // namespace

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
      plan.rendering.progress = progress.reporter(i, cameras.size());
      traffic[i].triangles = traffic[i].drawn = shared.first_numbers().back();
      traffic[i].most_drawn = traffic[i].drawn;
      DeepMap map = make_deep_map(ranks, scene, cameras[i], plan.rendering, traffic[i]);
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

}  // namespace fathom::app
