#include "apps/render/depth_buffer_channels.h"

#include <nlohmann/json.hpp>

#include "apps/render/depth_format_json.h"
#include "apps/render/render_report.h"

namespace fathom::app {

DepthFormat format_for(const DepthBufferPlan& plan, const Camera& camera) {
  return depth_format_of(camera, plan.mapping, plan.storage, plan.c);
}

DepthBufferReport add_depth_buffer_channels(DepthMap& map, const DepthBufferPlan& plan,
                                            const TriangleSource& triangles, const Camera& camera,
                                            const RenderOptions& options) {
  DepthBufferReport report{format_for(plan, camera), plan.against_exact, {}};
  report.seen =
      add_depth_buffer(map, triangles, camera, {report.format, plan.against_exact, options});
  map.texts["fathom.depth_format"] = json_of(report.format).dump();
  return report;
}

void drop_helpers(DepthMap& map, const DepthBufferPlan& plan) {
  if (plan.drops_id) std::erase_if(map.channels, [](const auto& c) { return c.name == "id"; });
}

}  // namespace fathom::app
