#pragma once

#include "fathom/pipeline/fragments/shading.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/pipeline/output/output_merger.h"

/// Scan conversion and the following stages, for triangles in the window: fragments, depth test,
/// shading, output merger.
namespace fathom::pipeline {

enum class ShadingRate {
  per_sample,
  /// Once for each pixel and triangle: at the centre or, if that is not covered, at the mean of the
  /// covered samples (multisampling).
  per_pixel,
};

struct RasterizerSettings {
  const PipelineOptions& options;
  /// Of each object.
  const std::vector<DrawRules>& rules;
  const GridSamples& pattern;
  ShadingRate rate = ShadingRate::per_sample;
  /// Without a depth test, later triangles are on top (the painter's algorithm).
  bool depth_tested = true;
  /// The part of the window that is drawn to.
  PixelWindow window;
  /// Called for each fragment that is merged; null for nobody.
  const ObserveMerge* observe = nullptr;
  /// Whether lines are rectangles one pixel wide, and points squares of one pixel, that are
  /// sampled; otherwise each fills whole pixels.
  bool outlines_have_area = false;
};

/// Draws triangles in their order. `shader` may be null if no colours are requested.
template <class Real>
void rasterize(const std::vector<WindowTriangle<Real>>& triangles,
               const RasterizerSettings& settings, Shader<Real>* shader, FrameBuffer& target,
               PipelineStatistics& statistics);

/// Draws lines, with a depth test at each pixel, or at each sample where they have an area.
/// Source   [GL46] 14.4 and 14.5.4: points and lines under multisampling
template <class Real>
void rasterize_lines(const std::vector<WindowLine<Real>>& lines, const RasterizerSettings& settings,
                     FrameBuffer& target, PipelineStatistics& statistics);

/// Draws the pixel that each point lies in, with a depth test.
template <class Real>
void rasterize_points(const std::vector<WindowPoint<Real>>& points,
                      const RasterizerSettings& settings, FrameBuffer& target,
                      PipelineStatistics& statistics);

}  // namespace fathom::pipeline
