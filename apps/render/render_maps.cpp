#include "apps/render/render_maps.h"

#include <algorithm>
#include <limits>

#include "apps/render/camera_warnings.h"
#include "apps/render/map_additions.h"
#include "apps/render/map_warnings.h"
#include "apps/render/render_input.h"
#include "apps/render/render_memory.h"
#include "apps/render/render_outputs.h"
#include "apps/render/render_plan.h"
#include "apps/render/render_report.h"
#include "apps/render/thread_limit.h"
#include "apps/shell/about_output.h"
#include "apps/shell/exit_status.h"
#include "apps/shell/progress.h"
#include "apps/shell/stopwatch.h"
#include "fathom/camera/camera_files.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/png_sidecar.h"
#include "fathom/render.h"

namespace fathom::app {
namespace {

/// Makes the map of a camera, checks it where that is asked for, and writes it.
MapReport make_map(const MapPlan& plan, const RenderInput& scene, const MotionOptions& motion,
                   const Camera& camera, RenderOutputs& outputs, std::size_t number,
                   const std::function<void(double)>& progress, const Console& console) {
  const std::string& name = outputs.map_name(number);
  MapReport report{.map = name, .engine = plan.rendering.engine};
  RenderOptions options = plan.rendering;
  options.statistics = &report.statistics;
  options.progress = progress;

  Stopwatch stopwatch;
  // A depth that the file cannot hold is told with the name of its map.
  DepthMap map = about_output(name, [&] { return scene.render(camera, options); });
  motion.describe(map, motion.time_or_start());
  report.width = map.width;
  report.height = map.height;
  report.seconds.render = stopwatch.lap();
  const auto render_again = [&](const RenderOptions& o) { (void)scene.render(camera, o); };
  const auto mattes = [&](const MatteKind& by) {
    return find_mattes(scene.outline(), camera, options, by);
  };
  add_planned(map, plan, name, {scene.triangles(), camera, options, render_again, mattes}, report,
              console);
  stopwatch.lap();
  map = plan.storage.dressed(std::move(map), name, std::numeric_limits<double>::infinity());
  outputs.map(number).write(
      [&](const auto& path) { write_map(map, path, plan.format, plan.writing); });
  if (plan.storage.png_sidecar) outputs.sidecar(number).write(png_sidecar(map));
  warn_of_codes_beyond(map, name, console);
  report.seconds.write = stopwatch.lap();
  return report;
}

int render_maps(const RenderArguments& arguments, MapPlan plan, const Console& console) {
  const ThreadLimit limit(plan.rendering.threads);
  Stopwatch stopwatch;
  const auto place = arguments.stream ? RenderInput::Place::files : RenderInput::Place::memory;
  RenderInput scene(arguments.scene, place,
                    {.segments = plan.needs_segments(), .normals = plan.needs_normals()}, console);
  const double seconds_reading = stopwatch.lap();
  const std::vector<Camera> cameras = arguments.camera.get(scene.outline(), console);
  scene.place(arguments.motion);
  warn_of_missing_segments(scene.triangles(), plan.rendering.channels, console);
  check_cameras(cameras, plan, arguments.output);
  RenderOutputs outputs(arguments, cameras);
  outputs.write_cameras(to_json(cameras) + "\n");

  RenderMemory memory;
  // Files are read to keep memory small.
  if (cameras.size() > 1 && !arguments.stream) plan.rendering.kept = &memory;
  std::vector<MapReport> reports;
  bool all_agree = true;
  CameraWarnings warnings;
  {
    Progress progress(console, "rendering");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      reports.push_back(make_map(plan, scene, arguments.motion, cameras[i], outputs, i,
                                 progress.reporter(i, cameras.size()), console));
      MapReport& report = reports.back();
      report.seconds.read = seconds_reading;
      if (i == 0) warn_of(report.statistics, console);
      warnings.note(scene.outline(), cameras[i], report.statistics.pixels_with_surface);
      all_agree = all_agree && (!report.verification || report.verification->agrees());
    }
  }
  warnings.tell(console);
  outputs.write_statistics(as_json(reports));
  outputs.commit();
  return all_agree ? done : answer_is_no;
}

int render_deep_maps(const RenderArguments& arguments, const DeepMapPlan& plan,
                     const Console& console) {
  RenderOptions options = plan.rendering;
  const ThreadLimit limit(options.threads);
  Scene scene = arguments.scene.read(console, {.hash = true});
  const std::vector<Camera> cameras = arguments.camera.get(scene, console);
  scene = arguments.motion.placed(std::move(scene));
  check_cameras(cameras, plan, arguments.output);
  RenderOutputs outputs(arguments, cameras);
  outputs.write_cameras(to_json(cameras) + "\n");
  CameraWarnings warnings;
  {
    Progress progress(console, "rendering");
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      options.progress = progress.reporter(i, cameras.size());
      DeepMap map = render_deep(scene, cameras[i], options);
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
  return arguments.deep ? render_deep_maps(arguments, plan_deep_maps(arguments), console)
                        : render_maps(arguments, plan_maps(arguments), console);
}

}  // namespace fathom::app
