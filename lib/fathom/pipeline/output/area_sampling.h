#pragma once

#include "fathom/camera/camera.h"
#include "fathom/pipeline/fragments/shading.h"
#include "fathom/pipeline/output/output_merger.h"

namespace fathom::pipeline {

/// Area sampling: each pixel's colour is the mean of the surfaces that are seen in its square, each
/// weighted by its visible area and shaded at the centroid of that area (pixel_partition.h).
///
/// Rounded  like any sample of the pipeline: corners to the subpixel grid, and their depths. What
///          is nearer is decided by the window depth, with the polygon offset, before it is stored;
///          for mappings that are not projections by the depth along the view. Areas follow in
///          binary64. How far the picture is from exact areas of the scene itself:
///          `fathom study antialiasing`.
/// Source   [WA77], [Cat78]
template <class Real>
ColourImage area_sampled(const std::vector<WindowTriangle<Real>>& triangles, const Camera& camera,
                         const PipelineOptions& options, const PixelWindow& window,
                         Shader<Real>& shader, PipelineStatistics& statistics);

}  // namespace fathom::pipeline
