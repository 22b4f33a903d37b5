#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/depth_format/stored_depth.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/rgb_image.h"
#include "fathom/pipeline/geometry/painters_algorithm.h"
#include "fathom/pipeline/options.h"
#include "fathom/pipeline/render_moving.h"
#include "fathom/scene/scene.h"

/// The front door to the pipeline of the textbooks.
namespace fathom {

/// What a pipeline's depth buffer holds at the end, pixel by pixel, row by row from the top.
struct PipelineDepthBuffer {
  DepthFormat format;                       ///< with the near and far that were clipped with
  std::array<double, 2> depth_range{0, 1};  ///< what near and far become
  /// With an orthographic camera the matrices of standard, opengl and reversed make a window depth
  /// that is affine in the depth: (D − near)/(far − near), reversed 1 minus that.
  bool orthographic = false;
  std::vector<StoredDepth> stored;  ///< where nothing was written: what it was cleared to
  std::vector<bool> written;
  /// Empty where no object has a stencil state.
  std::vector<std::uint8_t> stencil;
};

/// What a graphics pipeline computes of the scene, as a map and a picture.
struct PipelineRendering {
  /// Channels Z, id, face and object, those that are asked for. Lines and points are numbered on
  /// after all triangles, object by object, lines first; they are of no face. Its camera has the
  /// near and far that the pipeline clipped with, so that an exact map can be made for it.
  DepthMap map;
  RgbImage picture;  ///< empty where it is not asked for
  pipeline::PipelineStatistics statistics;
  pipeline::PainterStatistics painter;
  Camera camera;
  PipelineDepthBuffer depth_buffer;
};

/// Refuses channels that the pipeline does not give. Fails with UsageError.
void require_pipeline_channels(const std::vector<Channel>& channels);

/// Rounded   every value, as the options say (pipeline/); nothing here is exact.
/// Fails     InputError if the scene or the camera has a fault (find_fault), the image has more
///           than 2⁴⁴ pixels, or the texture cannot be read;
///           UsageError as require_pipeline_channels and pipeline::require_meaningful.
PipelineRendering render_by_pipeline(const Scene& scene, const Camera& camera,
                                     const pipeline::PipelineOptions& options,
                                     const std::vector<Channel>& channels, bool with_picture);

/// The same of a scene that moves while the shutter is open; the map is that of the time at which
/// it
/// closes. Fails    also as pipeline::render_moving.
PipelineRendering render_by_pipeline(MovingScene& scene, const Camera& camera,
                                     const pipeline::PipelineOptions& options,
                                     const pipeline::Shutter& shutter,
                                     const std::vector<Channel>& channels, bool with_picture);

/// Adds what the depth buffer holds as channels: `Zwindow`, or `Zwindow.high` and `Zwindow.low`, as
/// depth_buffer/depth_buffer.h stores them; `Zdecoded`, the depth that the stored value means, in
/// scene units, +∞ where nothing was written; `stencil` (UINT), if there is one.
///
/// Exact    Zdecoded: the depth range, then the format, are inverted exactly, and the result is
///          rounded once. What polygon offset has moved beyond near or far is decoded as near or
///          far.
/// Fails    UsageError where near and far have the same window depth, so that none can be decoded.
void add_depth_buffer(DepthMap& map, const PipelineDepthBuffer& buffer);

}  // namespace fathom
