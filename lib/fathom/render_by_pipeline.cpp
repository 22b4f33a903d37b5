#include "fathom/render_by_pipeline.h"

#include <algorithm>
#include <limits>

#include "fathom/depth_buffer/buffer_channels.h"
#include "fathom/depth_format/encode.h"
#include "fathom/failures/errors.h"
#include "fathom/map_description.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/pipeline/geometry/vertex_transform.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/rendering/segment_channels.h"
#include "fathom/scene/scene_segments.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {
namespace {

/// For each object, the number after its last line and point; lines and points are numbered after
/// all triangles.
std::vector<std::uint64_t> ends_of_lines(const Scene& scene, std::uint64_t triangles) {
  std::vector<std::uint64_t> ends;
  std::uint64_t end = triangles;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    ends.push_back(end += mesh.lines.size() + mesh.points.size());
  }
  return ends;
}

/// The value of a channel for a triangle.
std::uint32_t number_of(const TriangleOrigin& origin, Channel channel,
                        const SceneSegments& segments) {
  if (channel == Channel::face) return origin.face;
  const auto by = segmentation_of(channel);
  return by ? segments.number(*by, origin) : origin.object;
}

/// The same of a line or a point, which is of no face.
std::uint32_t number_of_line(std::size_t object, Channel channel, const SceneSegments& segments) {
  if (channel == Channel::face) return no_surface;
  const auto by = segmentation_of(channel);
  return by ? segments.number_of_object(*by, object) : static_cast<std::uint32_t>(object);
}

/// A channel of the pipeline's map.
ImageChannel channel_of(const Scene& scene, const pipeline::PipelineFrame& frame, Channel channel) {
  if (channel == Channel::Z) return {"Z", frame.depth};
  if (channel == Channel::id) return {"id", frame.id};
  Samples<std::uint32_t> values(frame.id.size(), no_surface);
  const TriangleSource triangles(scene);
  const SceneSegments segments(triangles, segmentations_of({channel}));
  const std::vector<std::uint64_t> ends = ends_of_lines(scene, triangles.count());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (frame.id[i] == no_surface) continue;
    if (frame.id[i] >= triangles.count()) {
      const auto object = std::ranges::upper_bound(ends, frame.id[i]) - ends.begin();
      values[i] = number_of_line(static_cast<std::size_t>(object), channel, segments);
    } else {
      values[i] = number_of(triangles.origin(frame.id[i]), channel, segments);
    }
  }
  return {std::string(description_of(channel).name), std::move(values)};
}

/// Inverts the depth range and the format.
class Decoder {
 public:
  explicit Decoder(const PipelineDepthBuffer& buffer)
      : format_(buffer.format),
        near_(Dyadic(buffer.depth_range[0])),
        extent_(Dyadic(buffer.depth_range[1]) - Dyadic(buffer.depth_range[0])),
        known_(bits_of(format_.storage) <= 16 ? std::size_t{1} << 16 : 0) {
    if (buffer.orthographic && !pipeline::is_per_fragment(format_.mapping)) {
      reversed_ = is_reversed(format_.mapping);
      format_.mapping = Mapping::linear;
    }
    if (extent_.sign() == Sign::zero)
      throw UsageError(Setting{"depth_range"},
                       "near and far have the same window depth, so depths cannot be decoded");
  }

  float operator()(StoredDepth stored) {
    if (stored.bits >= known_.size()) return decoded(stored);
    std::optional<float>& known = known_[stored.bits];
    if (!known) known = decoded(stored);
    return *known;
  }

 private:
  [[nodiscard]] float decoded(StoredDepth stored) const {
    const Ratio one = Dyadic(1.0);
    Ratio value = quotient(value_of(format_.storage, stored) - near_, extent_);
    if (value.sign() == Sign::negative) value = Ratio();
    if (one < value) value = one;
    if (reversed_) value = one - value;
    const std::optional<Real> depth = depth_of(format_, value);
    return depth ? round_to_binary32(*depth) : std::numeric_limits<float>::infinity();
  }

  DepthFormat format_;
  bool reversed_ = false;  ///< where the mapping is not
  Ratio near_, extent_;
  /// A buffer of 16 bits holds the same values again and again.
  std::vector<std::optional<float>> known_;
};

PipelineDepthBuffer depth_buffer_of(const Scene& scene, const Camera& camera,
                                    const pipeline::PipelineOptions& options,
                                    pipeline::PipelineFrame& frame) {
  PipelineDepthBuffer buffer{options.depth_format,
                             options.depth_range,
                             is_orthographic(camera.projection),
                             std::move(frame.stored),
                             std::move(frame.depth_written),
                             {}};
  buffer.format.near = frame.statistics.near;
  buffer.format.far = frame.statistics.far;
  const auto has_stencil = [](const DrawState& s) { return s.stencil.has_value(); };
  if (std::ranges::any_of(scene.draw_states, has_stencil))
    buffer.stencil = std::move(frame.stencil);
  return buffer;
}

PipelineRendering rendering_of(const Scene& scene, const Camera& camera,
                               const pipeline::PipelineOptions& options,
                               pipeline::PipelineFrame frame, const std::vector<Channel>& channels,
                               bool with_picture) {
  PipelineRendering result{{}, {}, frame.statistics, frame.painter, camera, {}};
  result.camera.near = frame.statistics.near;
  result.camera.far = frame.statistics.far;
  result.map.width = camera.width;
  result.map.height = camera.height;
  for (const Channel channel : channels) {
    result.map.channels.push_back(channel_of(scene, frame, channel));
  }
  describe_map(scene, result.camera, "pipeline", result.map);
  if (with_picture) result.picture = pipeline::to_rgb(frame.picture);
  result.depth_buffer = depth_buffer_of(scene, camera, options, frame);
  return result;
}

}  // namespace

void add_depth_buffer(DepthMap& map, const PipelineDepthBuffer& buffer) {
  const StandardArithmetic standard;
  Decoder decoder(buffer);
  if (!buffer.stencil.empty())
    map.channels.push_back(
        {"stencil", Samples<std::uint32_t>(buffer.stencil.begin(), buffer.stencil.end())});
  depth_buffer::BufferChannels channels(map, buffer.format, false);
  for (std::size_t i = 0; i < buffer.stored.size(); ++i) {
    channels.store(i, buffer.stored[i]);
    if (buffer.written[i]) channels.decoded[i] = decoder(buffer.stored[i]);
  }
}

void require_pipeline_channels(const std::vector<Channel>& channels) {
  for (const Channel channel : channels) {
    if (channel != Channel::Z && description_of(channel).kind != ChannelKind::identifier) {
      throw UsageError(Setting{"channels"},
                       "the pipeline gives Z, id, face, object, material, group, part and label");
    }
  }
}

PipelineRendering render_by_pipeline(const Scene& scene, const Camera& camera,
                                     const pipeline::PipelineOptions& options,
                                     const std::vector<Channel>& channels, bool with_picture) {
  const StandardArithmetic standard;
  require_pipeline_channels(channels);
  return rendering_of(scene, camera, options,
                      pipeline::render_frame(scene, camera, options, with_picture), channels,
                      with_picture);
}

PipelineRendering render_by_pipeline(MovingScene& scene, const Camera& camera,
                                     const pipeline::PipelineOptions& options,
                                     const pipeline::Shutter& shutter,
                                     const std::vector<Channel>& channels, bool with_picture) {
  const StandardArithmetic standard;
  require_pipeline_channels(channels);
  pipeline::PipelineFrame frame =
      pipeline::render_moving(scene, camera, options, shutter, with_picture);
  return rendering_of(scene.at(shutter.close), camera, options, std::move(frame), channels,
                      with_picture);
}

}  // namespace fathom
