#include <cmath>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/image/background.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/convert.h"
#include "fathom/image/pixel_place.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

const ImageChannel& depth_channel(const DepthMap& map, const std::string& asked) {
  const ImageChannel* channel = map.find(asked.empty() ? "Z" : own_channel_name(map, asked));
  if (!channel && asked.empty() && map.channels.size() == 1) channel = &map.channels.front();
  if (!channel && asked.empty())
    throw ambiguous_channel(names_of_channels(map), "the map has no Z, only", "convert");
  if (!channel) throw missing_channel(map, asked);
  return *channel;
}

/// Decodes 16-bit codes: code / scale in binary64, which rounds once; binary32 from the exact
/// quotient, so as not to be rounded twice.
template <class T>
Samples<T> decode(const Samples<std::uint16_t>& codes, const std::optional<double>& scale) {
  if (!scale)
    throw InputError("the codes carry no scale (fathom:scale), so their depth is not known");
  std::vector<T> depth_of(65536);
  depth_of[0] = std::numeric_limits<T>::infinity();
  for (std::size_t code = 1; code < depth_of.size(); ++code) {
    if constexpr (std::is_same_v<T, double>)
      depth_of[code] = static_cast<double>(code) / *scale;
    else
      depth_of[code] = round_to_binary32(Ratio(Dyadic(static_cast<double>(code)), Dyadic(*scale)));
  }
  Samples<T> values(codes.size());
  for (std::size_t k = 0; k < codes.size(); ++k) values[k] = depth_of[codes[k]];
  return values;
}

template <class T>
Samples<T> as_floating_point(const DepthMap& map, const ImageChannel& channel) {
  return std::visit(
      [&](const auto& values) -> Samples<T> {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if constexpr (std::is_same_v<Value, std::uint16_t>)
          return decode<T>(values, map.png_scale);
        else if constexpr (std::is_same_v<Value, std::uint32_t>)
          throw UsageError("channel '" + channel.name + "' holds integers, not depths");
        else
          return Samples<T>(values.begin(), values.end());
      },
      channel.values);
}

/// How many surfaces lie beyond the codes is counted where that is no fault.
Samples<std::uint16_t> encode(const DepthMap& map, const ImageChannel& channel, double scale,
                              std::uint64_t* beyond) {
  const Samples<double> depths = as_floating_point<double>(map, channel);
  const std::vector<std::uint8_t> surface = surface_mask(map, channel);
  Samples<std::uint16_t> codes(depths.size());
  for (std::size_t k = 0; k < depths.size(); ++k) {
    if (!surface[k]) continue;
    std::optional<std::uint64_t> code;
    if (std::isfinite(depths[k])) code = round_to_integer(Dyadic(scale) * Dyadic(depths[k]), 65535);
    if (!code && beyond && depths[k] > 0) {
      ++*beyond;
      continue;
    }
    if (!code || *code == 0)
      throw OutputError(image::place_of_pixel(k, map.width) + "depth " + std::to_string(depths[k]) +
                        " times the scale " + std::to_string(scale) +
                        " does not fit the codes 1 to 65535");
    codes[k] = static_cast<std::uint16_t>(*code);
  }
  return codes;
}

}  // namespace

DepthMap with_storage(const DepthMap& map, const std::string& asked, StoredType type,
                      std::optional<double> scale, bool beyond_is_none) {
  const StandardArithmetic standard;
  require_valid(map);
  const ImageChannel& channel = depth_channel(map, asked);
  DepthMap result = map;
  result.channels.clear();
  result.png_scale.reset();
  result.codes_beyond.reset();
  // That of codes is 0, and +∞ where they become depths.
  const bool from_codes = std::holds_alternative<Samples<std::uint16_t>>(channel.values);
  if (from_codes || type == StoredType::scaled_unorm16) result.texts.erase(background_text);
  // What is widened is the value as it was stored.
  const auto background = declared_background(result);
  if (background && std::holds_alternative<Samples<float>>(channel.values))
    declare_background(result, static_cast<double>(static_cast<float>(*background)));
  switch (type) {
    case StoredType::binary32:
      result.channels.push_back({channel.name, as_floating_point<float>(map, channel)});
      break;
    case StoredType::binary64:
      result.channels.push_back({channel.name, as_floating_point<double>(map, channel)});
      break;
    case StoredType::scaled_unorm16:
      if (!scale || !(*scale > 0) || !std::isfinite(*scale))
        throw UsageError("16-bit codes need a scale that is a positive number");
      if (kind_of(channel) != ChannelKind::depth)
        throw UsageError("channel '" + channel.name +
                         "' is not one of depth: it has no 16-bit codes");
      if (beyond_is_none) result.codes_beyond = 0;
      result.channels.push_back(
          {channel.name,
           encode(map, channel, *scale, beyond_is_none ? &*result.codes_beyond : nullptr)});
      result.png_scale = scale;
      break;
  }
  return result;
}

}  // namespace fathom
