#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/depth_format/encode.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/rgb_image.h"
#include "fathom/pipeline/geometry/painters_algorithm.h"
#include "fathom/pipeline/options.h"
#include "fathom/pipeline/render_moving.h"
#include "fathom/scene/scene.h"

/// The front door to the pipeline of the textbooks.
namespace fathom {

/// Final content of a pipeline's depth buffer, pixel by pixel, row by row from the top.
struct PipelineDepthBuffer {
  DepthFormat format;                       ///< with the near and far that were clipped with
  std::array<double, 2> depth_range{0, 1};  ///< the window depths of near and far
  /// With an orthographic camera the matrices of standard, opengl and reversed make a window depth
  /// that is affine in the depth: (D − near)/(far − near), reversed 1 minus that.
  bool orthographic = false;
  std::vector<StoredDepth> stored;  ///< the cleared value where nothing was written
  std::vector<bool> written;
  /// Empty where no object has a stencil state.
  std::vector<std::uint8_t> stencil;
};

/// Result of a graphics pipeline for a scene: a map and a picture.
struct PipelineRendering {
  /// The requested channels of Z, id, face and object. Lines and points are numbered after all
  /// triangles, object by object, lines first, and belong to no face. The map's camera has the near
  /// and far with which the pipeline clipped, so that an exact map can be made for it.
  DepthMap map;
  RgbImage picture;  ///< empty if not requested
  pipeline::PipelineStatistics statistics;
  pipeline::PainterStatistics painter;
  Camera camera;
  PipelineDepthBuffer depth_buffer;
};

/// Refuses channels that the pipeline does not give. Fails with UsageError.
void require_pipeline_channels(const std::vector<Channel>& channels);

/// Rounded   every value, as the options specify (pipeline/); no value is exact.
/// Fails     InputError if the scene or the camera has a fault (find_fault), the image has more
///           than 2⁴⁴ pixels, or the texture cannot be read;
///           UsageError as require_pipeline_channels and pipeline::require_meaningful.
PipelineRendering render_by_pipeline(const Scene& scene, const Camera& camera,
                                     const pipeline::PipelineOptions& options,
                                     const std::vector<Channel>& channels, bool with_picture);

/// The same for a scene that moves while the shutter is open; the map shows the time at which the
/// shutter closes.
/// Fails    also as pipeline::render_moving.
PipelineRendering render_by_pipeline(MovingScene& scene, const Camera& camera,
                                     const pipeline::PipelineOptions& options,
                                     const pipeline::Shutter& shutter,
                                     const std::vector<Channel>& channels, bool with_picture);

/// Adds the content of the depth buffer as channels: `Zwindow`, or `Zwindow.high` and
/// `Zwindow.low`, as depth_buffer/depth_buffer.h stores them; `Zdecoded`, the depth of the stored
/// value in scene units, +∞ where nothing was written; `stencil` (UINT), if the pipeline used one.
///
/// Exact    Zdecoded: the depth range, then the format, are inverted exactly, and the result is
///          rounded once. Values that polygon offset moved beyond near or far are decoded as near
///          or far.
/// Fails    UsageError if near and far have the same window depth, so that decoding is impossible.
void add_depth_buffer(DepthMap& map, const PipelineDepthBuffer& buffer);

}  // namespace fathom
