#include "fathom/rendering/map_background.h"

#include <algorithm>
#include <string>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/image/channel_table.h"
#include "fathom/rendering/channel_values.h"
#include "fathom/threads/threads.h"

namespace fathom::rendering {
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
  const std::string name(description_of(Channel::valid).name);
  Samples<std::uint32_t> values = room_for<std::uint32_t>(name, memory).values;
  std::fill(values.begin(), values.end(), 1);
  return {name, std::move(values)};
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
