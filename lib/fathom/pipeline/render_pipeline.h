#pragma once

#include <optional>
#include <vector>

#include "fathom/image/depth_map.h"
#include "fathom/pipeline/geometry/painters_algorithm.h"
#include "fathom/pipeline/output/output_merger.h"

/// The pipeline from end to end, one file per stage, in the order of the data:
///   primitive_assembly, vertex_transform, window_transform (clipping, division, viewport),
///   back_face_culling; painters_algorithm if asked for; rasterizer with subpixel_grid (scan
///   conversion), interpolation, depth_test, shading and texture; output_merger, fxaa.
namespace fathom::pipeline {

struct PipelineFrame {
  /// The surface at each pixel's centre: planar depth in scene units, as 1 / (interpolated 1/w)
  /// rounded to binary32, and the number of the triangle; background as in the specification. If
  /// several surfaces are drawn into a pixel, the last fragment that passed counts, except for
  /// blended fragments that leave no depth.
  Samples<float> depth;
  Samples<std::uint32_t> id;
  /// The final content of the depth buffer, background included; and the pixels where it was
  /// written.
  std::vector<StoredDepth> stored;
  std::vector<bool> depth_written;
  std::vector<std::uint8_t> stencil;
  /// The picture, antialiased; empty if not requested.
  ColourImage picture;
  PipelineStatistics statistics;
  PainterStatistics painter;
};

/// Renders a scene. The picture takes most of the time.
/// Fails    UsageError for incompatible options; InputError if the scene or the camera has a fault
///          (find_fault), for more than 2⁴⁴ pixels, for an unusable texture, or for a scene without
///          texture coordinates.
PipelineFrame render_frame(const Scene& scene, const Camera& camera, const PipelineOptions& options,
                           bool with_picture);

/// Observations while a frame is drawn.
struct FrameWatch {
  /// Every fragment at the pixel's centre, in drawing order, including fragments that fail a test.
  std::vector<MergeStep> merger;
  /// If the scene is painted.
  PainterTrace painter;
};

/// Draws one pixel of a frame with a single sample and reports each step. Without a pixel: only the
/// painter's order.
/// Fails    as render_frame().
FrameWatch watch_frame(const Scene& scene, const Camera& camera, const PipelineOptions& options,
                       const std::optional<Pixel>& pixel);

}  // namespace fathom::pipeline
