#pragma once

#include "fathom/pipeline/output_merger.h"
#include "fathom/pipeline/shading.h"

namespace fathom::pipeline {

/// Area sampling: each pixel's colour is the mean over its square of the surfaces seen there, each
/// weighted with the exact area that is seen of it. In a pixel, the parts of triangles are taken
/// from the nearest on and cut out of what is left of the square, exactly, on the subpixel grid;
/// the order is that of the depths at the parts' centroids, so surfaces that the order is that of
/// the depths at the parts' centroids, so surfaces that penetrate each other inside a pixel are
/// weighted wrongly there. Each part is shaded at its centroid. Source   K. Weiler and P. Atherton,
/// Hidden surface removal using polygon area sorting, SIGGRAPH
///          1977; E. Catmull, A hidden-surface algorithm with anti-aliasing, SIGGRAPH 1978.
template <class Real>
ColourImage area_sampled(const std::vector<WindowTriangle<Real>>& triangles,
                         const PipelineOptions& options, const PixelWindow& window,
                         Shader<Real>& shader, std::uint32_t width, std::uint32_t height,
                         PipelineStatistics& statistics);

}  // namespace fathom::pipeline
