#include "apps/render/map_additions.h"

#include "apps/render/depth_buffer_channels.h"
#include "apps/render/map_verification.h"
#include "apps/shell/stopwatch.h"
#include "fathom/area/sampled_coverage.h"

namespace fathom::app {

bool has_additions(const MapPlan& plan) {
  return !plan.mattes.empty() || plan.samples || plan.depth_buffer || plan.verified_pixels;
}

void add_planned(DepthMap& map, const MapPlan& plan, const std::string& name,
                 const RenderedFrom& from, MapReport& report, const Console& console) {
  Stopwatch stopwatch;
  for (const MatteKind& by : plan.mattes) add_mattes(map, from.mattes(by));
  if (plan.samples) {
    add_sampled_coverage(map, from.triangles, from.camera, *plan.samples, from.options);
    map.texts["fathom.samples"] = plan.samples->name;
  }
  report.seconds.render += stopwatch.lap();
  if (plan.depth_buffer) {
    report.depth_buffer = add_depth_buffer_channels(map, *plan.depth_buffer, from.triangles,
                                                    from.camera, from.options);
  }
  report.seconds.depth_format = stopwatch.lap();
  if (plan.verified_pixels) {
    report.verification = verify_map(
        map, name, {from.triangles, from.camera, from.options, *plan.verified_pixels, from.render},
        console);
  }
  report.seconds.verify = stopwatch.lap();
  if (plan.depth_buffer) drop_helpers(map, *plan.depth_buffer);
}

}  // namespace fathom::app
