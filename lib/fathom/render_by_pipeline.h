#pragma once

#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/rgb_image.h"
#include "fathom/pipeline/geometry/painters_algorithm.h"
#include "fathom/pipeline/options.h"
#include "fathom/pipeline/render_moving.h"
#include "fathom/scene/scene.h"

/// The front door to the pipeline of the textbooks.
namespace fathom {

/// What a graphics pipeline computes of the scene, as a map and a picture.
struct PipelineRendering {
  /// Channels Z, id, face and object, those that are asked for. Its camera has the near and far
  /// that the pipeline clipped with, so that an exact map can be made for it.
  DepthMap map;
  RgbImage picture;  ///< empty where it is not asked for
  pipeline::PipelineStatistics statistics;
  pipeline::PainterStatistics painter;
  Camera camera;
};

/// Refuses channels that the pipeline does not give. Fails with UsageError.
void require_pipeline_channels(const std::vector<Channel>& channels);

/// Rounded   every value, as the options say (pipeline/); nothing here is exact.
/// Fails     InputError if the scene or the camera has a fault (find_fault), the image has more than
///           2⁴⁴ pixels, or the texture cannot be read;
///           UsageError as require_pipeline_channels and pipeline::require_meaningful.
PipelineRendering render_by_pipeline(const Scene& scene, const Camera& camera,
                                     const pipeline::PipelineOptions& options,
                                     const std::vector<Channel>& channels, bool with_picture);

/// The same of a scene that moves while the shutter is open; the map is that of the time at which it
/// closes. Fails    also as pipeline::render_moving.
PipelineRendering render_by_pipeline(MovingScene& scene, const Camera& camera,
                                     const pipeline::PipelineOptions& options,
                                     const pipeline::Shutter& shutter,
                                     const std::vector<Channel>& channels, bool with_picture);

}  // namespace fathom
