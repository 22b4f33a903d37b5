#include "fathom/image/preview.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/compare_internal.h"
#include "fathom/image/files/file_texts.h"
#include "fathom/image/pictures/legend.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/percentage.h"

namespace fathom::image {
namespace {

constexpr Rgb wrong_colour{215, 25, 28}, right_colour{146, 154, 164};

struct Square {
  std::uint32_t left, top, right, bottom;  ///< right and bottom excluded
};

/// Around a pixel, `reach` pixels to each side, within the picture.
Square square_around(const RgbImage& picture, std::size_t pixel, std::uint32_t reach) {
  const auto x = static_cast<std::uint32_t>(pixel % picture.width);
  const auto y = static_cast<std::uint32_t>(pixel / picture.width);
  return {x - std::min(x, reach), y - std::min(y, reach), std::min(x + reach + 1, picture.width),
          std::min(y + reach + 1, picture.height)};
}

/// How far squares reach: 0 if single pixels are visible. Large pictures are drawn by every k-th
/// pixel, which a square must not slip through.
std::uint32_t reach_of_squares(const RgbImage& picture, std::size_t wrong) {
  const std::uint32_t side = std::max(picture.width, picture.height);
  const bool is_seen = side <= enlarged_up_to || wrong > picture.pixels.size() / 200;
  return is_seen ? 0 : std::max(2U, side / reduced_from);
}

/// "wrong: 7 (0.3 %)"
std::string share_text(const std::string& what, std::size_t part, std::size_t whole) {
  return what + ": " + std::to_string(part) + " (" + text::percentage(part, whole) + ")";
}

/// Draws the channel Zfight: the pixels where the wrong surface wins stand out from neutral
/// colours. Few such pixels of a picture that will not be enlarged are drawn as larger squares.
void draw_fights(Sheet& sheet, const DepthMap& map, const ImageChannel& channel, Rgb background) {
  const auto& fights = std::get<Samples<std::uint32_t>>(channel.values);
  const std::vector<std::uint8_t> mask = surface_mask(map, channel);
  RgbImage& picture = sheet.picture;
  std::vector<std::size_t> wrong;
  std::size_t surface = 0;
  for (std::size_t k = 0; k < mask.size(); ++k) {
    picture.pixels[k] = mask[k] ? right_colour : background;
    surface += mask[k] ? 1 : 0;
    if (mask[k] && fights[k] != 0) wrong.push_back(k);
  }
  const std::uint32_t reach = reach_of_squares(picture, wrong.size());
  for (const std::size_t pixel : wrong) {
    const Square square = square_around(picture, pixel, reach);
    for (std::uint32_t y = square.top; y < square.bottom; ++y)
      for (std::uint32_t x = square.left; x < square.right; ++x) picture.at(x, y) = wrong_colour;
  }
  const std::string side = std::to_string(2 * reach + 1);
  sheet.entries.push_back({right_colour, share_text("right", surface - wrong.size(),
                                                    std::max<std::size_t>(1, surface))});
  sheet.entries.push_back(
      {wrong_colour, share_text("wrong", wrong.size(), std::max<std::size_t>(1, surface))});
  if (reach > 0 && !wrong.empty())
    sheet.entries.push_back({wrong_colour, "each drawn as " + side + " × " + side + " pixels"});
  if (surface < mask.size()) sheet.entries.push_back({background, "no surface"});
}

}  // namespace
}  // namespace fathom::image

namespace fathom {
using namespace image;

namespace {

constexpr Rgb plus_infinity_colour{230, 25, 120}, minus_infinity_colour{120, 40, 200},
    nan_colour{255, 120, 0}, none_colour{96, 96, 96};

/// A neutral colour that is not in the colour map.
Rgb background_colour(ColourMap colours) {
  if (colours == ColourMap::grey) return {74, 92, 122};
  return colours == ColourMap::diverging ? Rgb{150, 156, 164} : Rgb{206, 210, 216};
}

/// The title of the picture of a channel.
std::string title_of(const DepthMap& map, const ImageChannel& channel) {
  std::string text = channel.name;
  const std::string meaning = meaning_of(channel.name);
  if (!meaning.empty() && meaning != channel.name) text += " – " + meaning;
  const bool codes = std::holds_alternative<Samples<std::uint16_t>>(channel.values);
  if (codes && !map.png_scale) text += " (codes of unknown scale)";
  return text;
}

/// Legend entries for the pixels that are not plain values, if there are any.
class Specials {
 public:
  void count(const std::string& what, Rgb colour) {
    auto& [seen, shade] = counts_[what];
    ++seen;
    shade = colour;
  }
  void add_to(Sheet& sheet, std::uint64_t pixels) const {
    for (const char* what : {"no surface", "none", "+∞", "−∞", "not a number"})
      if (const auto found = counts_.find(what); found != counts_.end())
        sheet.entries.push_back(
            {found->second.second,
             std::string(what) + " (" + text::percentage(found->second.first, pixels) + ")"});
  }

 private:
  std::map<std::string, std::pair<std::uint64_t, Rgb>> counts_;
};

struct Range {
  double low = 0, high = 0;
  bool any = false;
};

/// Calls visit(value) for the finite values of the surface.
template <class Visit>
void for_finite(const Reading& values, const std::vector<std::uint8_t>& mask, const Visit& visit) {
  for (std::size_t k = 0; k < mask.size(); ++k) {
    const double value = values.value(k);
    if (mask[k] && std::isfinite(value)) visit(value);
  }
}

Range range_of(const Reading& values, const std::vector<std::uint8_t>& mask) {
  Range range;
  for_finite(values, mask, [&](double value) {
    range.low = range.any ? std::min(range.low, value) : value;
    range.high = range.any ? std::max(range.high, value) : value;
    range.any = true;
  });
  return range;
}

Range bar_range(const Reading& values, const std::vector<std::uint8_t>& mask,
                const ImageChannel& channel, const PreviewOptions& options) {
  Range range = channel.name == "A" ? Range{0, 1, true} : range_of(values, mask);
  if (drawing_of(channel) == ChannelDrawing::errors && options.colours == ColourMap::diverging &&
      range.any) {
    range.high = std::max(std::abs(range.low), std::abs(range.high));
    range.low = -range.high;
  }
  if (options.low) range.low = *options.low;
  if (options.high) range.high = *options.high;
  if (options.low || options.high) {
    range.any = true;
    if (!(range.low < range.high) || !std::isfinite(range.low) || !std::isfinite(range.high))
      throw UsageError("the colour bar's low end is not below its high end");
  }
  return range;
}

void draw_numbers(Sheet& sheet, const DepthMap& map, const ImageChannel& channel,
                  const PreviewOptions& options) {
  const Reading values(channel, map.png_scale);
  const std::vector<std::uint8_t> mask = surface_mask(map, channel);
  const Range range = bar_range(values, mask, channel, options);
  std::vector<double> finite;
  if (options.scale == ColourScale::equalised)
    for_finite(values, mask, [&](double value) { finite.push_back(value); });
  const ScaledRange scaled(range.any ? options.scale : ColourScale::linear, range.low, range.high,
                           finite);
  Specials specials;
  for (std::size_t k = 0; k < mask.size(); ++k) {
    Rgb& pixel = sheet.picture.pixels[k];
    const double value = values.value(k);
    const auto special = [&](const char* what, Rgb colour) {
      specials.count(what, colour);
      pixel = colour;
    };
    if (!mask[k])
      special("no surface", background_colour(*options.colours));
    else if (std::isnan(value))
      special("not a number", nan_colour);
    else if (std::isinf(value))
      value > 0 ? special("+∞", plus_infinity_colour) : special("−∞", minus_infinity_colour);
    else
      pixel = colour_at(*options.colours, scaled.place(value));
  }
  if (range.any && range.low < range.high) {
    if (options.scale != ColourScale::linear)
      sheet.subtitle = std::string(name_of(options.scale)) + " scale, ";
    sheet.bar =
        ColourBar{[&options](double t) { return colour_at(*options.colours, t); }, scaled.marks()};
  } else if (range.any) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.9g everywhere", range.low);
    sheet.entries.push_back({colour_at(*options.colours, 0.5), text.data()});
  }
  specials.add_to(sheet, mask.size());
}

/// The distinct identifiers, by descending number of pixels, then in ascending order.
std::vector<std::uint32_t> by_pixels(const Samples<std::uint32_t>& ids) {
  std::vector<std::uint32_t> sorted(ids.begin(), ids.end());
  std::ranges::sort(sorted);
  std::vector<std::pair<std::ptrdiff_t, std::uint32_t>> counted;  // minus the number of pixels
  for (auto at = sorted.begin(); at != sorted.end();) {
    const auto end = std::upper_bound(at, sorted.end(), *at);
    counted.emplace_back(at - end, *at);
    at = end;
  }
  std::ranges::sort(counted);
  std::vector<std::uint32_t> distinct;
  distinct.reserve(counted.size());
  for (const auto& [pixels, id] : counted) distinct.push_back(id);
  return distinct;
}

void draw_identifiers(Sheet& sheet, const DepthMap& map, const ImageChannel& channel,
                      const PreviewOptions& options) {
  const auto& ids = std::get<Samples<std::uint32_t>>(channel.values);
  const std::vector<std::string>* names = names_of_channel(map, channel.name);
  const bool segments = shows_segments(channel.name);
  const auto is_plain = [&](std::uint32_t id) {
    return id != no_surface && !(segments && id == no_segment);
  };
  Specials specials;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    Rgb& pixel = sheet.picture.pixels[k];
    if (is_plain(ids[k])) {
      pixel = colour_of_identifier(ids[k]);
      continue;
    }
    const bool none = ids[k] == no_surface;
    pixel = none ? background_colour(*options.colours) : none_colour;
    specials.count(none ? "no surface" : "none", pixel);
  }
  constexpr std::size_t most_listed = 12;
  std::vector<std::uint32_t> distinct = by_pixels(ids);
  std::erase_if(distinct, [&](std::uint32_t id) { return !is_plain(id); });
  for (std::size_t k = 0; k < std::min(distinct.size(), most_listed); ++k) {
    const std::uint32_t id = distinct[k];
    std::string text = std::to_string(id);
    if (names && id < names->size()) text += "  " + (*names)[id];
    sheet.entries.push_back({colour_of_identifier(id), text});
  }
  if (distinct.size() > most_listed)
    sheet.entries.push_back(
        {{255, 255, 255}, "and " + std::to_string(distinct.size() - most_listed) + " more"});
  specials.add_to(sheet, ids.size());
}

/// The three parts of a channel of directions as RGB.
void draw_normals(Sheet& sheet, const DepthMap& map, const PreviewOptions& options) {
  const std::string& name = options.channel;
  std::array<const Samples<float>*, 3> parts{};
  for (std::size_t c = 0; c < 3; ++c) {
    parts[c] = map.values<float>(name + "." + "XYZ"[c]);
    if (!parts[c]) {
      throw UsageError("the map has no normals " + name + ".X, " + name + ".Y, " + name + ".Z");
    }
  }
  const std::vector<std::uint8_t> mask = surface_mask(map, *map.find(name + ".X"));
  Specials specials;
  for (std::size_t k = 0; k < mask.size(); ++k) {
    const Rgb background = background_colour(*options.colours);
    if (!mask[k]) specials.count("no surface", background);
    for (std::size_t c = 0; c < 3; ++c) {
      const double n = std::clamp(double{(*parts[c])[k]}, -1.0, 1.0);
      const double shade = std::isnan(n) ? 0 : 127.5 * (n + 1);
      sheet.picture.pixels[k][c] =
          mask[k] ? static_cast<std::uint8_t>(std::lround(shade)) : background[c];
    }
  }
  sheet.entries = {{{255, 128, 128}, "+x"}, {{0, 128, 128}, "−x"},   {{128, 255, 128}, "+y"},
                   {{128, 0, 128}, "−y"},   {{128, 128, 255}, "+z"}, {{128, 128, 0}, "−z"}};
  specials.add_to(sheet, mask.size());
}

}  // namespace

ColourMap colours_for(ChannelDrawing drawing) {
  return drawing == ChannelDrawing::errors ? ColourMap::diverging : ColourMap::viridis;
}

RgbImage draw_preview(const DepthMap& map, const PreviewOptions& given) {
  const StandardArithmetic standard;
  require_valid(map);
  PreviewOptions options = given;
  options.channel = own_channel_name(map, options.channel);
  const auto use_colours = [&options](ColourMap colours) {
    if (!options.colours) options.colours = colours;
  };
  Sheet sheet;
  sheet.picture = RgbImage(map.width, map.height);
  const std::optional<Channel> asked = channel_named(options.channel);
  if (asked && description_of(*asked).kind == ChannelKind::direction) {
    sheet.title = title_of(map, {options.channel, Samples<float>{}});
    use_colours(ColourMap::viridis);
    draw_normals(sheet, map, options);
  } else {
    const ImageChannel* channel = options.channel.empty() && !map.find("Z") && !map.channels.empty()
                                      ? &map.channels.front()
                                      : map.find(options.channel.empty() ? "Z" : options.channel);
    if (!channel) throw missing_channel(map, options.channel.empty() ? "Z" : options.channel);
    sheet.title = title_of(map, *channel);
    if (!options.unit.empty()) sheet.title += " [" + options.unit + "]";
    const ChannelDrawing drawing = drawing_of(*channel);
    use_colours(colours_for(drawing));
    if (drawing == ChannelDrawing::fights)
      draw_fights(sheet, map, *channel, background_colour(*options.colours));
    else if (drawing == ChannelDrawing::identifiers)
      draw_identifiers(sheet, map, *channel, options);
    else
      draw_numbers(sheet, map, *channel, options);
  }
  sheet.subtitle += std::to_string(map.width) + " × " + std::to_string(map.height) + " pixels";
  FittedPicture fitted = fit_to_screen(std::move(sheet.picture));
  if (!fitted.remark.empty()) sheet.subtitle += ", " + fitted.remark;
  sheet.picture = std::move(fitted.image);
  return lay_out(sheet);
}

}  // namespace fathom
