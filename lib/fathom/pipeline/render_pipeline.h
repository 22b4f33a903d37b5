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
  /// What is seen at each pixel's centre: planar depth in scene units, as 1 / (interpolated 1/w)
  /// rounded to binary32, and the number of the triangle; background as in the specification. Of
  /// several surfaces that are drawn into a pixel, the last that passed, but for blended ones that
  /// leave no depth.
  Samples<float> depth;
  Samples<std::uint32_t> id;
  /// What the depth buffer holds at the end, background included; and where it was written.
  std::vector<StoredDepth> stored;
  std::vector<bool> depth_written;
  std::vector<std::uint8_t> stencil;
  /// The picture, antialiased; empty if it is not asked for.
  ColourImage picture;
  PipelineStatistics statistics;
  PainterStatistics painter;
};

/// Renders a scene. The picture is what takes most of the time.
/// Fails    UsageError for options that do not go together; InputError where the scene or the
///          camera has a fault (find_fault), for more than 2⁴⁴ pixels, a texture that cannot be
///          used, or a scene without texture coordinates.
PipelineFrame render_frame(const Scene& scene, const Camera& camera, const PipelineOptions& options,
                           bool with_picture);

/// What can be observed while a frame is drawn.
struct FrameWatch {
  /// Every fragment at the pixel's centre, those that fail a test among them, in drawing order.
  std::vector<MergeStep> merger;
  /// If the scene is painted.
  PainterTrace painter;
};

/// Draws one pixel of a frame with one sample, and reports how it came about. Without a pixel:
/// the painter's order alone.
/// Fails    as render_frame().
FrameWatch watch_frame(const Scene& scene, const Camera& camera, const PipelineOptions& options,
                       const std::optional<Pixel>& pixel);

}  // namespace fathom::pipeline
