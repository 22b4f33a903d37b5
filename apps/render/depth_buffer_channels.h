#pragma once

#include "apps/render/render_plan.h"
#include "fathom/depth_buffer/depth_buffer.h"

namespace fathom::app {

/// What was stored in a map as a depth buffer would store it.
struct DepthBufferReport {
  DepthFormat format;
  bool against_exact = false;
  DepthBufferStatistics seen;
};

/// The depth format with the camera's near and far. Fails with UsageError where they do not fit it.
DepthFormat format_for(const DepthBufferPlan& plan, const Camera& camera);

/// Adds the channels of the plan to a map that was rendered with these options, and a text that
/// describes the format.
DepthBufferReport add_depth_buffer_channels(DepthMap& map, const DepthBufferPlan& plan,
                                            const TriangleSource& triangles, const Camera& camera,
                                            const RenderOptions& options);

/// Takes away what the map has for the depth buffer alone.
void drop_helpers(DepthMap& map, const DepthBufferPlan& plan);

}  // namespace fathom::app
