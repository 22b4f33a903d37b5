#pragma once

#include <functional>
#include <string>

#include "apps/render/render_plan.h"
#include "apps/render/render_report.h"
#include "apps/shell/console.h"
#include "fathom/camera/camera.h"
#include "fathom/image/cryptomatte.h"
#include "fathom/image/depth_map.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/triangle_source.h"

namespace fathom::app {

/// What a map was rendered from.
struct RenderedFrom {
  TriangleSource triangles;
  const Camera& camera;
  const RenderOptions& options;
  /// Renders the same map with other options.
  std::function<Rendered(const RenderOptions&)> render;
  /// Those of the plan, each asked for once, in its order.
  std::function<Mattes(const MatteKind&)> mattes;
};

/// Whether the plan has anything that add_planned() does, for which it needs the whole map.
bool has_additions(const MapPlan& plan);

/// Adds to a map, called `name`, what the plan asks for beside the channels that are rendered, and
/// verifies it where that is asked for; the report gets what is said of that.
/// Fails    UsageError, InputError as the functions that do it.
void add_planned(DepthMap& map, const MapPlan& plan, const std::string& name,
                 const RenderedFrom& from, MapReport& report, const Console& console);

}  // namespace fathom::app
