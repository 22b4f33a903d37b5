#pragma once

#include "fathom/camera/camera.h"
#include "fathom/fast/stream.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/rgb_image.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/scene/scene.h"
#include "fathom/scene/streamed_scene.h"
#include "fathom/triangle/options.h"

/// The front door.
namespace fathom {

/// Renders `scene` as `camera` sees it. The map carries what is needed to recompute it: camera,
/// sources, object names, engine.
/// Exact    every value is the exact number of the specification rounded once (section 6).
/// Fails    InputError if the camera is refused (find_fault); OutputError if a depth does not fit
///          the encoding asked for.
DepthMap render(const Scene& scene, const Camera& camera, const RenderOptions& options = {});

/// The same map of a scene whose meshes stay in their files, by the fast engine.
/// Fails    also InputError if a file changes meanwhile; UsageError if another engine is asked for.
DepthMap render(const StreamedScene& scene, const Camera& camera, const RenderOptions& options = {},
                const StreamLimits& limits = {});

/// The visible fragments of every pixel with their exact areas (specification, section 8). Of the
/// options culling, threads and progress count.
/// Fails    InputError if the camera is refused.
DeepMap render_deep(const Scene& scene, const Camera& camera, const RenderOptions& options = {});

/// Adds Cryptomatte channels by object, CryptoObject00.R and so on, with the exact visible area of
/// each object in each pixel rounded once. Objects of the same name are one. The map is one of this
/// scene and camera; of the options culling, threads and progress count.
void add_cryptomatte(DepthMap& map, const Scene& scene, const Camera& camera,
                     const RenderOptions& options = {});

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

/// Rounded   every value, as the options say (pipeline/); nothing here is exact.
/// Fails     as render; UsageError for other channels.
PipelineRendering render_by_pipeline(const Scene& scene, const Camera& camera,
                                     const pipeline::PipelineOptions& options,
                                     const std::vector<Channel>& channels, bool with_picture);

}  // namespace fathom
