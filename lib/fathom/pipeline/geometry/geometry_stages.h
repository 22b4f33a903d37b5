#pragma once

#include "fathom/pipeline/geometry/window_triangle.h"
#include "fathom/pipeline/output/draw_rules.h"

namespace fathom::pipeline {

/// The stages up to the window: transform, clip, divide, cull, viewport, in that order. Parts of a
/// clipped triangle come one after another. `rules` are the rules of each object.
template <class Real>
WindowPrimitives<Real> to_window(const Scene& scene, const Camera& camera,
                                 const PipelineOptions& options,
                                 const std::vector<DrawRules>& rules,
                                 PipelineStatistics& statistics);

}  // namespace fathom::pipeline
