#pragma once

#include "fathom/pipeline/fragments/shading.h"
#include "fathom/pipeline/output/output_merger.h"

namespace fathom::pipeline {

/// Area sampling: each pixel's colour is the mean of the surfaces that are seen in its square, each
/// weighted by its visible area and shaded at its centroid. The parts of triangles in a pixel are
/// taken from the nearest to the farthest and cut out of what is left of the square.
///
/// Exact    the areas, of triangles on the subpixel grid.
/// Rounded  the order: it is that of the depths at the parts' centroids, so surfaces that penetrate
///          each other inside a pixel are weighted wrongly there.
/// Source   [WA77], [Cat78]
template <class Real>
ColourImage area_sampled(const std::vector<WindowTriangle<Real>>& triangles,
                         const PipelineOptions& options, const PixelWindow& window,
                         Shader<Real>& shader, std::uint32_t width, std::uint32_t height,
                         PipelineStatistics& statistics);

}  // namespace fathom::pipeline
