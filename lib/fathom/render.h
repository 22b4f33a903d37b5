#pragma once

#include <functional>
#include <optional>

#include "fathom/camera/camera.h"
#include "fathom/fast/render_memory.h"
#include "fathom/fast/stream.h"
#include "fathom/image/cryptomatte.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/row_share.h"
#include "fathom/mesh/segmentation.h"
#include "fathom/rendering/options.h"
#include "fathom/rendering/rendered.h"
#include "fathom/scene/scene.h"
#include "fathom/scene/streamed_scene.h"

/// Entry points of the exact engines. render_by_pipeline.h computes the results of a graphics
/// pipeline instead.
namespace fathom {

/// Renders `scene` as seen by `camera`. The map contains the data for recomputing it: camera,
/// sources, object names, engine.
/// Exact    every value is the exact number of the specification rounded once (section 6).
/// Fails    InputError if the scene or the camera has a fault (find_fault) or the image more than
///          2⁴⁴ pixels; UsageError for meaningless options (require_meaningful); OutputError if a
///          depth does not fit the requested encoding.
Rendered render(const Scene& scene, const Camera& camera, const RenderOptions& options = {},
                const RenderContext& context = {});

/// Renders into an existing map, reusing its channel buffers where name, type and size match, and
/// replacing everything else. With a RenderMemory in the context, a frame of the same scene and
/// size allocates no memory.
/// Fails    as render(); `rendered` is empty then.
void render_into(Rendered& rendered, const Scene& scene, const Camera& camera,
                 const RenderOptions& options = {}, const RenderContext& context = {});

/// The same map of a scene whose meshes stay in their files, by the fast engine.
/// Fails    also InputError if a file changes meanwhile; UsageError if `options` has another
///          engine.
Rendered render(const StreamedScene& scene, const Camera& camera, const RenderOptions& options = {},
                const StreamLimits& limits = {}, const RenderContext& context = {});

/// Adds the data that render() adds to its maps to a map whose channels have been assembled from
/// parts (fast/some_tiles.h). Uses the objects, sources and segments of the scene, and the pixels
/// with a surface of the statistics.
void finish_map(DepthMap& map, const Scene& scene, const Camera& camera,
                const RenderOptions& options, const RenderStatistics& statistics);

/// The visible fragments of every pixel with their exact areas (specification, section 8). Of the
/// options culling and threads count. `share`: the rows that are made, where several processes
/// share them out; pixels of other rows have no samples.
/// Fails    InputError and UsageError as render().
DeepMap render_deep(const Scene& scene, const Camera& camera, const RenderOptions& options = {},
                    const RowShare& share = {}, const std::function<void(double)>& progress = {});

/// Adds Cryptomatte channels by object, CryptoObject00.R and so on, with the exact visible area of
/// each object in each pixel rounded once; or by material, group or part, as CryptoMaterial00.R and
/// so on. Segments with the same name are merged; triangles without a name have the empty name. The
/// map must be a map of this scene and camera. Only culling and threads of the options are used.
/// Fails    InputError and UsageError as render(); UsageError for labels, which have no names;
///          InputError also if the map has a fault or is not of the camera's size.
void add_cryptomatte(DepthMap& map, const Scene& scene, const Camera& camera,
                     const RenderOptions& options = {},
                     std::optional<Segmentation> by = std::nullopt,
                     const std::function<void(double)>& progress = {});

/// The added channels. `share`: the computed rows; pixels of other rows are empty. The names are
/// the names of all segments, followed by the empty name if a pixel of these rows shows a triangle
/// without a name.
/// Fails    as add_cryptomatte(), except for faults of the map.
Mattes find_mattes(const Scene& scene, const Camera& camera, const RenderOptions& options,
                   std::optional<Segmentation> by, const RowShare& share = {},
                   const std::function<void(double)>& progress = {});

}  // namespace fathom
