#include "fathom/rendering/map_of_camera.h"

#include <algorithm>
#include <string>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/rendering/segment_channels.h"
#include "fathom/threads/threads.h"

namespace fathom::rendering {
namespace {

/// The values of a channel if it exists and has this type.
template <class T>
T* values_of(DepthMap& map, const std::string& name) {
  Samples<T>* values = map.values<T>(name);
  return values ? values->data() : nullptr;
}

EncodedValues encoded_values_of(DepthMap& map, const std::string& name) {
  return {values_of<float>(map, name), values_of<double>(map, name),
          values_of<std::uint16_t>(map, name)};
}

std::array<std::uint32_t*, all_segmentations.size()> segment_values_of(DepthMap& map) {
  std::array<std::uint32_t*, all_segmentations.size()> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = values_of<std::uint32_t>(
        map, std::string(description_of(channel_of(all_segmentations[i])).name));
  }
  return values;
}

}  // namespace

ChannelValues::ChannelValues(DepthMap& map)
    : depth(encoded_values_of(map, "Z")),
      distance(encoded_values_of(map, "distance")),
      coverage(values_of<float>(map, "A")),
      low(values_of<float>(map, "Zlow")),
      valid(values_of<std::uint32_t>(map, "valid")),
      id(values_of<std::uint32_t>(map, "id")),
      face(values_of<std::uint32_t>(map, "face")),
      object(values_of<std::uint32_t>(map, "object")),
      segments(segment_values_of(map)),
      normal{values_of<float>(map, "N.X"), values_of<float>(map, "N.Y"),
             values_of<float>(map, "N.Z")},
      camera_normal{values_of<float>(map, "Nc.X"), values_of<float>(map, "Nc.Y"),
                    values_of<float>(map, "Nc.Z")},
      shading_normal{values_of<float>(map, "Ns.X"), values_of<float>(map, "Ns.Y"),
                     values_of<float>(map, "Ns.Z")},
      position{values_of<float>(map, "P.X"), values_of<float>(map, "P.Y"),
               values_of<float>(map, "P.Z")},
      barycentric{values_of<float>(map, "bary.U"), values_of<float>(map, "bary.V")} {}

bool ChannelValues::wants_origins() const {
  return face || object ||
         std::any_of(segments.begin(), segments.end(), [](const auto* values) { return values; });
}

void ChannelValues::write(std::size_t pixel, const OriginNumbers& numbers) const {
  const auto values = origins();
  const auto all = numbers.all();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i]) values[i][pixel] = all[i];
  }
}

namespace {

/// The sources of the memory of a map's channels.
struct MapMemory {
  std::size_t pixels;
  const RenderOptions& options;
  const RenderContext& context;
  /// A map whose channels are obsolete.
  DepthMap& before;
};

template <class T>
struct Room {
  Samples<T> values;
  /// Whether they are 0.
  bool is_zeroed;
};

template <class T>
Room<T> room_for(const std::string& name, const MapMemory& memory) {
  // First the caller's own memory, which may also be lent to the previous map.
  void* const lent = memory.context.memory ? memory.context.memory(name) : nullptr;
  if (lent) return {Samples<T>::lent(static_cast<T*>(lent), memory.pixels), false};
  if (auto* values = memory.before.values<T>(name); values && values->size() == memory.pixels) {
    return {std::move(*values), false};
  }
  return {Samples<T>(memory.pixels), true};
}

template <class T>
ImageChannel channel_with(const std::string& name, T background, const MapMemory& memory,
                          MapBackground& to_fill) {
  auto [values, is_zeroed] = room_for<T>(name, memory);
  if (!is_zeroed || background != T{0}) to_fill.add(name, values.data(), background);  // NaN too
  return {name, std::move(values)};
}

/// The channel `valid` of a camera whose samples all have a ray, complete. A camera with a lens
/// writes it itself.
ImageChannel valid_everywhere(const MapMemory& memory) {
  Samples<std::uint32_t> values = room_for<std::uint32_t>("valid", memory).values;
  std::fill(values.begin(), values.end(), 1);
  return {"valid", std::move(values)};
}

/// A channel whose kind decides which value means "no surface".
ImageChannel channel_of_kind(const std::string& name, const ChannelDescription& d,
                             const MapMemory& memory, MapBackground& to_fill) {
  const DepthEncoding::Type encoding = memory.options.depth_encoding.type;
  if (d.type == ChannelType::identifier)
    return channel_with<std::uint32_t>(name, no_surface, memory, to_fill);
  if (d.type == ChannelType::encoded && encoding == DepthEncoding::Type::scaled_unorm16) {
    return channel_with<std::uint16_t>(name, 0, memory, to_fill);
  }
  const float value = d.kind == ChannelKind::depth      ? Backgrounds::depth
                      : d.kind == ChannelKind::position ? Backgrounds::position
                                                        : Backgrounds::other;
  if (d.type == ChannelType::encoded && encoding == DepthEncoding::Type::binary64) {
    return channel_with<double>(name, value, memory, to_fill);
  }
  return channel_with<float>(name, value, memory, to_fill);
}

}  // namespace

void require_channels_of(const Camera& camera, const RenderOptions& options) {
  if (std::ranges::count(options.channels, Channel::A) == 0) return;
  require_straight(camera,
                   "channel A: the edges of triangles are curves in this image, and the last "
                   "digit of an area between curves cannot be proved; leave out A");
}

void MapBackground::fill(std::size_t first_pixel, std::size_t count) const {
  for_each(
      [&](auto* values, auto background) { std::fill_n(values + first_pixel, count, background); });
}

UnfilledMap make_unfilled_map(const Camera& camera, const RenderOptions& options,
                              const RenderContext& context, DepthMap before) {
  UnfilledMap made;
  DepthMap& map = made.map;
  map.width = camera.width;
  map.height = camera.height;
  const MapMemory memory{static_cast<std::size_t>(camera.width) * camera.height, options, context,
                         before};
  std::vector<Channel> seen;
  for (const Channel channel : options.channels) {
    if (std::find(seen.begin(), seen.end(), channel) != seen.end()) continue;
    seen.push_back(channel);
    if (channel == Channel::valid) {
      map.channels.push_back(valid_everywhere(memory));
      continue;
    }
    for (const std::string& name : part_names(channel)) {
      map.channels.push_back(
          channel_of_kind(name, description_of(channel), memory, made.background));
    }
  }
  if (options.depth_encoding.type == DepthEncoding::Type::scaled_unorm16) {
    map.png_scale = options.depth_encoding.scale / options.depth_encoding.divisor;
  }
  return made;
}

DepthMap make_background(const Camera& camera, const RenderOptions& options,
                         const RenderContext& context, DepthMap before) {
  UnfilledMap made = make_unfilled_map(camera, options, context, std::move(before));
  const std::size_t pixels = std::size_t{camera.width} * camera.height;
  // A huge page is zeroed by whichever thread touches it first, while others wait for it.
  constexpr std::size_t part = (std::size_t{1} << 21) / sizeof(float);
  parallel_for(std::size_t{0}, (pixels + part - 1) / part, [&](std::size_t i) {
    made.background.fill(i * part, std::min(part, pixels - i * part));
  });
  return std::move(made.map);
}

void require_map_of(const Camera& camera, const DepthMap& map) {
  require_valid(map);
  if (map.width == camera.width && map.height == camera.height) return;
  throw InputError("map: its size is " + std::to_string(map.width) + "x" +
                   std::to_string(map.height) + ", expected the camera's, " +
                   std::to_string(camera.width) + "x" + std::to_string(camera.height));
}

}  // namespace fathom::rendering
