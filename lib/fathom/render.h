#pragma once

#include "fathom/exact/fast_stream.h"
#include "fathom/exact/options.h"
#include "fathom/image/depth_map.h"
#include "fathom/scene/camera.h"
#include "fathom/scene/scene.h"
#include "fathom/scene/streamed_scene.h"

/// The front door.
namespace fathom {

/// Renders `scene` as `camera` sees it. The map carries what is needed to recompute it: camera,
/// sources, object names, engine.
/// Exact    every value is the exact number of the specification rounded once (section 6).
/// Fails    InputError if the camera is refused (find_fault); OutputError if a depth does not fit
///          the encoding asked for.
DepthMap render(const Scene& scene, const Camera& camera, const RenderOptions& options = {});

/// The same map of a scene whose meshes stay in their files, by the fast engine.
/// Fails    also InputError if a file changes meanwhile; UsageError if another engine is asked for.
DepthMap render(const StreamedScene& scene, const Camera& camera, const RenderOptions& options = {},
                const StreamLimits& limits = {});

}  // namespace fathom
