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

/// The inputs of a map.
struct RenderedFrom {
  TriangleSource triangles;
  const Camera& camera;
  const RenderOptions& options;
  /// Renders the same map with other options.
  std::function<Rendered(const RenderOptions&)> render;
  /// The plan's mattes in order, each requested once.
  std::function<Mattes(const MatteKind&)> mattes;
};

/// Whether the plan adds channels to those that are rendered.
bool adds_channels(const MapPlan& plan);
/// Whether the plan has anything that add_planned() does, for which it needs the whole map.
bool has_additions(const MapPlan& plan);

/// Adds to a map, called `name`, everything that the plan requests in addition to rendered
/// channels, and verifies the map if requested; the report gets the result of the verification.
/// Fails    UsageError, InputError as the called functions.
void add_planned(DepthMap& map, const MapPlan& plan, const std::string& name,
                 const RenderedFrom& from, MapReport& report, const Console& console);

}  // namespace fathom::app
