#pragma once

#include "apps/render/render_plan.h"
#include "fathom/camera/camera.h"
#include "fathom/fast/stream.h"
#include "fathom/triangle/options.h"

namespace fathom::app {

/// Refuses an image that takes more memory than there is or --max-memory allows, before it tries: its map,
/// and what is needed to write it. Fails with InputError.
void check_size(const Camera& camera, const MapPlan& plan);
/// The same of a deep map, whose size is known when it is there.
void check_size(const Camera& camera, const DeepMapPlan& plan);

/// Of the memory that the map leaves over of what is allowed, a quarter for tiles, a sixteenth for
/// triangles.
StreamLimits stream_limits(const Camera& camera, const RenderOptions& options);

}  // namespace fathom::app
