#pragma once

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/rendering/options.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// The reference engine: the specification as code, brute force over the pixels of certified
/// bounding boxes, in exact numbers. It is the truth to which every other engine is held.
///
/// Unit     depths in scene units, of planar depth in the camera frame (specification, section 6).
/// Exact    every value is the exact number rounded once (specification, section 6).
/// Fails    InputError where scene or camera has a fault (find_fault); UsageError for meaningless
///          options (require_meaningful); OutputError if a depth does not fit
///          options.depth_encoding; it names the first such pixel in row order.
/// `before`  an obsolete map: its channels lend their memory where they fit.
Rendered render_reference(const Scene& scene, const Camera& camera, const RenderOptions& options,
                          const RenderContext& context = {}, DepthMap before = {});

}  // namespace fathom
