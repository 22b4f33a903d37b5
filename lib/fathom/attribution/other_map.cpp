#include "fathom/attribution/other_map.h"

#include <algorithm>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::attribution {
namespace {

const ImageChannel& depth_channel(const DepthMap& map, const std::string& name) {
  if (!name.empty()) {
    if (const ImageChannel* channel = map.find(own_channel_name(map, name))) return *channel;
    throw InputError(missing_channel(map, name).what());
  }
  if (const ImageChannel* channel = map.find("Z")) return *channel;
  for (const ImageChannel& channel : map.channels) {
    const bool is_number = !std::holds_alternative<Samples<std::uint32_t>>(channel.values);
    if (is_number && kind_of(channel) == ChannelKind::depth) return channel;
  }
  if (map.channels.size() == 1) return map.channels.front();
  throw InputError("of the map's channels " + list_of_channels(map) +
                   " none has a name for depths; expected Z, or the name of the depth channel");
}

}  // namespace

OtherMap other_map(const DepthMap& map, const std::string& name) {
  const StandardArithmetic standard;
  const ImageChannel& channel = depth_channel(map, name);
  const bool is_code = std::holds_alternative<Samples<std::uint16_t>>(channel.values);
  if (is_code && !map.png_scale) {
    throw InputError(Setting{"png_scale"},
                     "the map holds integers and does not say how many are a unit of depth");
  }
  OtherMap other{.width = map.width, .height = map.height};
  const std::vector<std::uint8_t> seen = surface_mask(map, channel, background_of(map, channel));
  const double scale = map.png_scale.value_or(1);
  if (is_code) other.code_scale = scale;
  std::visit(
      [&](const auto& values) {
        for (std::size_t i = 0; i < values.size(); ++i) {
          const double stored = static_cast<double>(values[i]);
          other.values.push_back(is_code ? stored / scale : stored);
          other.depths.push_back(seen[i] == 0 ? std::numeric_limits<double>::infinity()
                                              : other.values.back());
        }
      },
      channel.values);
  if (const auto* id = map.values<std::uint32_t>("id")) {
    other.triangles.assign(id->begin(), id->end());
  }
  return other;
}

DepthMap as_depth_map(const OtherMap& other) {
  const StandardArithmetic standard;
  DepthMap map{.width = other.width, .height = other.height};
  Samples<float> depths(other.depths.size());
  std::transform(other.depths.begin(), other.depths.end(), depths.begin(),
                 [](double depth) { return static_cast<float>(depth); });
  map.channels.push_back({"Z", std::move(depths)});
  if (!other.triangles.empty()) {
    map.channels.push_back({"id", Samples<std::uint32_t>(other.triangles)});
  }
  return map;
}

}  // namespace fathom::attribution
