#pragma once

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"
#include "fathom/rendering/options.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// The fast engine: floating point with proved bounds, and exact arithmetic where a bound does not
/// settle a decision (specification, section 7). Its map equals that of render_reference() bit for
/// bit, on every input; docs/error-analysis.md gathers the bounds.
///
/// Unit     depths in scene units, of planar depth in the camera frame (specification, section 6).
/// Exact    every value is the exact number rounded once.
/// Fails    as render_reference().
/// `before`  an obsolete map: its channels lend their memory where they fit.
Rendered render_fast(const Scene& scene, const Camera& camera, const RenderOptions& options,
                     const RenderContext& context = {}, DepthMap before = {});

/// The kind of vector instructions that the fast engine uses on this machine, by Highway's names:
/// "AVX2", "AVX3", … The map does not depend on it.
const char* vector_instructions();

}  // namespace fathom
