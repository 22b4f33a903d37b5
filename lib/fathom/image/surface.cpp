#include "fathom/image/surface.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "fathom/failures/errors.h"
#include "fathom/image/depth_map.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/decimal.h"

namespace fathom {
namespace {

/// `N.X` and `ViewLayer.N.X` → {"N", "X"}; `Z` → {"", "Z"}.
struct NameTail {
  std::string_view group, last;
};

NameTail tail_of(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string_view::npos) return {"", name};
  const std::string_view head = name.substr(0, dot);
  const std::size_t before = head.rfind('.');
  return {before == std::string_view::npos ? head : head.substr(before + 1), name.substr(dot + 1)};
}

template <class T>
std::vector<std::uint8_t> mask_of_all_but(const Samples<T>& values, double background) {
  const auto stored = static_cast<T>(background);
  std::vector<std::uint8_t> mask(values.size());
  std::transform(values.begin(), values.end(), mask.begin(), [stored](T value) {
    return !(value == stored || (value != value && stored != stored));
  });
  return mask;
}

template <class T>
std::vector<std::uint8_t> mask_of_numbers(const Samples<T>& values, const BackgroundRule& rule) {
  if (rule.only && rule.value) return mask_of_all_but(values, *rule.value);
  // A rule of 0 covers values below 0 as well: no depth is negative.
  std::vector<std::uint8_t> mask(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto value = static_cast<double>(values[k]);
    const bool background =
        !std::isfinite(value) ||
        (rule.value && (value == *rule.value || (*rule.value == 0 && value < 0)));
    mask[k] = !background;
  }
  return mask;
}

std::vector<std::uint8_t> mask_of_identifiers(const Samples<std::uint32_t>& ids) {
  std::vector<std::uint8_t> mask(ids.size());
  std::transform(ids.begin(), ids.end(), mask.begin(),
                 [](std::uint32_t id) { return id != no_surface; });
  return mask;
}

std::vector<std::uint8_t> depth_mask(const ImageChannel& channel, const BackgroundRule& rule) {
  return std::visit(
      [&](const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        if constexpr (std::is_same_v<Value, std::uint32_t>)
          return mask_of_identifiers(values);
        else
          return mask_of_numbers(values, rule);
      },
      channel.values);
}

/// Where any channel of the group is not 0 or, if `nan`, not NaN.
std::vector<std::uint8_t> group_mask(const DepthMap& map, const ImageChannel& channel, bool nan) {
  const std::string group = channel.name.substr(0, channel.name.rfind('.') + 1);
  std::vector<std::uint8_t> mask(std::size_t{map.width} * map.height);
  for (const ImageChannel& other : map.channels) {
    const auto* values = std::get_if<Samples<float>>(&other.values);
    if (!values || !other.name.starts_with(group) || kind_of(other) != kind_of(channel)) continue;
    for (std::size_t k = 0; k < values->size(); ++k)
      mask[k] |= nan ? !std::isnan((*values)[k]) : (*values)[k] != 0;
  }
  return mask;
}

}  // namespace

ChannelKind kind_of(const ImageChannel& channel) {
  if (std::holds_alternative<Samples<std::uint32_t>>(channel.values)) {
    const auto ours = channel_named(channel.name);
    const AddedChannel* const added = added_channel_named(channel.name);
    const bool is_number = (added && added->kind == ChannelKind::quantity) ||
                           (ours && description_of(*ours).type == ChannelType::identifier &&
                            description_of(*ours).kind == ChannelKind::quantity);
    return is_number ? ChannelKind::quantity : ChannelKind::identifier;
  }
  const auto [group, last] = tail_of(channel.name);
  if (std::holds_alternative<Samples<std::uint16_t>>(channel.values)) return ChannelKind::depth;
  if (const auto ours = channel_named(group); ours && !description_of(*ours).parts.empty()) {
    return description_of(*ours).kind;
  }
  if (const auto ours = channel_named(last);
      ours && description_of(*ours).kind == ChannelKind::depth) {
    return ChannelKind::depth;
  }
  if (group == "Normal") return ChannelKind::direction;
  if (group == "Position") return ChannelKind::position;
  static constexpr std::array<std::string_view, 4> depths{"ZBack", "depth", "Depth", "V"};
  const AddedChannel* const added = added_channel_named(last);
  const bool depth = std::ranges::find(depths, last) != depths.end() ||
                     (added && added->kind == ChannelKind::depth);
  if (last == "V" && group != "Depth" && group != "depth") return ChannelKind::quantity;
  return depth ? ChannelKind::depth : ChannelKind::quantity;
}

ChannelDrawing drawing_of(const ImageChannel& channel) {
  if (channel.name == "Zerror") return ChannelDrawing::errors;
  if (channel.name == "Zfight" && std::holds_alternative<Samples<std::uint32_t>>(channel.values)) {
    return ChannelDrawing::fights;
  }
  return kind_of(channel) == ChannelKind::identifier ? ChannelDrawing::identifiers
                                                     : ChannelDrawing::numbers;
}

const Samples<std::uint32_t>* identifiers_of(const DepthMap& map) {
  for (const char* name : {"id", "object", "face"})
    if (const auto* ids = map.values<std::uint32_t>(name)) return ids;
  return nullptr;
}

BackgroundRule detect_background(const ImageChannel& channel) {
  const StandardArithmetic standard;
  if (std::holds_alternative<Samples<std::uint16_t>>(channel.values)) return {0.0, ""};
  std::uint64_t count = 0;
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  std::uint64_t at_greatest = 0, not_positive = 0, zeros = 0;
  std::visit(
      [&](const auto& values) {
        for (const auto stored : values) {
          const auto value = static_cast<double>(stored);
          if (!std::isfinite(value)) {
            ++count;
            continue;
          }
          if (value > greatest) at_greatest = 0;
          greatest = std::max(greatest, value);
          least = std::min(least, value);
          at_greatest += value == greatest;
          not_positive += value <= 0;
          zeros += value == 0;
        }
      },
      channel.values);
  if (count > 0) return {};
  const auto note = [](const char* value, std::uint64_t pixels) {
    return "no infinity or NaN; " + std::string(value) + " at " + std::to_string(pixels) +
           " pixels is taken for background";
  };
  if (greatest == 1e10) return {1e10, note("1e10", at_greatest)};
  if (greatest == 65504) return {65504.0, note("65504", at_greatest)};
  if (greatest == static_cast<double>(std::numeric_limits<float>::max()))
    return {greatest, note("the greatest binary32", at_greatest)};
  if (tail_of(channel.name).last == "disparity") {
    if (zeros > 0) return {0.0, note("0", zeros), true};
    return {};
  }
  if (not_positive > 0) return {0.0, note(least < 0 ? "0 or below" : "0", not_positive)};
  return {};
}

BackgroundRule background_of(const DepthMap& map, const ImageChannel& channel) {
  const StandardArithmetic standard;
  const bool codes = std::holds_alternative<Samples<std::uint16_t>>(channel.values);
  const std::optional<double> declared = codes ? std::nullopt : declared_background(map);
  if (!declared) return detect_background(channel);
  return {.value = declared, .only = true};
}

std::vector<std::uint8_t> surface_mask(const DepthMap& map, const ImageChannel& channel,
                                       const std::optional<BackgroundRule>& rule,
                                       bool by_identifiers) {
  const StandardArithmetic standard;
  require_valid(map);
  std::vector<std::uint8_t> everywhere(std::size_t{map.width} * map.height, 1);
  // `A` and the coverages of Cryptomatte are shares of a pixel, and `valid` marks pixels with a
  // ray: these channels have no background.
  if (channel.name == "A" || channel.name == "valid" || channel.name.ends_with(".coverage")) {
    return everywhere;
  }
  const Samples<std::uint32_t>* ids = by_identifiers ? identifiers_of(map) : nullptr;
  if (ids) return mask_of_identifiers(*ids);
  switch (kind_of(channel)) {
    case ChannelKind::identifier:
    case ChannelKind::depth:
      return depth_mask(channel, rule ? *rule : background_of(map, channel));
    case ChannelKind::direction:
      return group_mask(map, channel, false);
    case ChannelKind::position:
      return group_mask(map, channel, true);
    case ChannelKind::quantity:
      break;
  }
  const ImageChannel* depth = map.find("Z");
  if (depth && kind_of(*depth) == ChannelKind::depth)
    return depth_mask(*depth, rule ? *rule : background_of(map, *depth));
  return everywhere;
}

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

std::string background_as_text(double value) {
  return std::isnan(value) ? "nan" : text::shortest_decimal(value);
}

/// The values of one channel; `surface` marks the pixels that show a surface.
template <class T>
void fill_background(const DepthMap& map, const std::string& name, Samples<T>& values,
                     const std::vector<std::uint8_t>& surface, double value) {
  const auto stored = static_cast<T>(value);
  if (std::isfinite(value) && !std::isfinite(stored)) {
    throw UsageError("background " + background_as_text(value) + " does not fit channel '" + name +
                     "', which is binary32");
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (surface[k] == 0) {
      values[k] = stored;
    } else if (std::isfinite(stored) && values[k] == stored) {
      throw OutputError(image::place_of_pixel(k, map.width) + "a surface has the value " +
                        background_as_text(value) + " in channel '" + name +
                        "', so that it cannot be the background: choose another");
    }
  }
}

}  // namespace

std::optional<double> declared_background(const DepthMap& map) {
  const StandardArithmetic standard;
  const auto found = map.texts.find(background_text);
  if (found == map.texts.end()) return std::nullopt;
  const std::string& text = found->second;
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (text == "inf") return unbounded;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(std::abs(value) < unbounded)) {
    throw InputError(std::string("its ") + background_text + " is '" + text.substr(0, 40) +
                     "': expected a number or nan");
  }
  return value;
}

void declare_background(DepthMap& map, double value) {
  const StandardArithmetic standard;
  map.texts.erase(background_text);
  if (value != unbounded) map.texts[background_text] = background_as_text(value);
}

DepthMap with_background(DepthMap map, double value, std::optional<double> now) {
  const StandardArithmetic standard;
  require_valid(map);
  if (value == -unbounded) throw UsageError("the background is 0, nan, inf or a number, not -inf");
  std::optional<BackgroundRule> rule;
  if (now) rule = BackgroundRule{.value = now, .only = true};
  // Of the map as it was: a channel may follow another.
  std::vector<std::vector<std::uint8_t>> surfaces(map.channels.size());
  for (std::size_t c = 0; c < map.channels.size(); ++c) {
    const ImageChannel& channel = map.channels[c];
    if (kind_of(channel) != ChannelKind::depth) continue;
    if (std::holds_alternative<Samples<std::uint16_t>>(channel.values)) {
      throw UsageError("the background of 16-bit codes is 0");
    }
    surfaces[c] = surface_mask(map, channel, rule);
  }
  for (std::size_t c = 0; c < map.channels.size(); ++c) {
    if (surfaces[c].empty()) continue;
    ImageChannel& channel = map.channels[c];
    if (auto* floats = std::get_if<Samples<float>>(&channel.values)) {
      fill_background(map, channel.name, *floats, surfaces[c], value);
    } else if (auto* doubles = std::get_if<Samples<double>>(&channel.values)) {
      fill_background(map, channel.name, *doubles, surfaces[c], value);
    }
  }
  declare_background(map, value);
  return map;
}

}  // namespace fathom
