#include "fathom/image/background.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/image/pixel_place.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/decimal.h"

namespace fathom {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

std::string background_as_text(double value) {
  return std::isnan(value) ? "nan" : text::shortest_decimal(value);
}

/// The values of one channel; `surface` is what it shows.
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
