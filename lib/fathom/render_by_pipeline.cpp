#include "fathom/render_by_pipeline.h"

#include "fathom/map_description.h"
#include "fathom/numeric/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {
namespace {

/// A channel of the pipeline's map.
ImageChannel channel_of(const Scene& scene, const pipeline::PipelineFrame& frame, Channel channel) {
  if (channel == Channel::Z) return {"Z", frame.depth};
  if (channel == Channel::id) return {"id", frame.id};
  Samples<std::uint32_t> values(frame.id.size(), no_surface);
  const TriangleSource triangles(scene);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (frame.id[i] == no_surface) continue;
    const TriangleOrigin origin = triangles.origin(frame.id[i]);
    values[i] = channel == Channel::face ? origin.face : origin.object;
  }
  return {channel == Channel::face ? "face" : "object", values};
}

PipelineRendering rendering_of(const Scene& scene, const Camera& camera,
                               const pipeline::PipelineFrame& frame,
                               const std::vector<Channel>& channels, bool with_picture) {
  PipelineRendering result{{}, {}, frame.statistics, frame.painter, camera};
  result.camera.near = frame.statistics.near;
  result.camera.far = frame.statistics.far;
  result.map.width = camera.width;
  result.map.height = camera.height;
  for (const Channel channel : channels) {
    result.map.channels.push_back(channel_of(scene, frame, channel));
  }
  describe_map(scene, result.camera, "pipeline", result.map);
  if (with_picture) result.picture = pipeline::to_rgb(frame.picture);
  return result;
}

}  // namespace

void require_pipeline_channels(const std::vector<Channel>& channels) {
  for (const Channel channel : channels) {
    if (channel != Channel::Z && channel != Channel::id && channel != Channel::face &&
        channel != Channel::object) {
      throw UsageError(Setting{"channels"}, "the pipeline gives Z, id, face and object");
    }
  }
}

PipelineRendering render_by_pipeline(const Scene& scene, const Camera& camera,
                                     const pipeline::PipelineOptions& options,
                                     const std::vector<Channel>& channels, bool with_picture) {
  const StandardArithmetic standard;
  require_pipeline_channels(channels);
  return rendering_of(scene, camera, pipeline::render_frame(scene, camera, options, with_picture),
                      channels, with_picture);
}

PipelineRendering render_by_pipeline(MovingScene& scene, const Camera& camera,
                                     const pipeline::PipelineOptions& options,
                                     const pipeline::Shutter& shutter,
                                     const std::vector<Channel>& channels, bool with_picture) {
  const StandardArithmetic standard;
  require_pipeline_channels(channels);
  const pipeline::PipelineFrame frame =
      pipeline::render_moving(scene, camera, options, shutter, with_picture);
  return rendering_of(scene.at(shutter.close), camera, frame, channels, with_picture);
}

}  // namespace fathom
