#include "fathom/image/convert.h"

#include <cmath>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/surface.h"
#include "fathom/numeric/double_word.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// √(1 + x'² + y'²) at the centre of pixel (i, j): ray distance over planar depth.
double stretch_at(const Camera& camera, double i, double j) {
  if (is_orthographic(camera.projection)) return 1;
  const auto [x, y, one] = point_at(camera, i, j, 1);
  return std::hypot(one, x, y);
}

/// Conversions at one pixel, all of them through planar depth.
struct Converter {
  DepthQuantity from, to;
  const Camera& camera;
  StereoRig rig;

  [[nodiscard]] double planar(double value, double i, double j) const {
    switch (from) {
      case DepthQuantity::planar_depth:
        return value;
      case DepthQuantity::ray_distance:
        return value / stretch_at(camera, i, j);
      case DepthQuantity::disparity:
        break;
    }
    if (value + rig.doffs < 0)
      throw InputError("pixel (" + std::to_string(static_cast<long>(i)) + ", " +
                       std::to_string(static_cast<long>(j)) +
                       "): the disparity with its offset is negative, so nothing can be there");
    return std::abs(camera.projection.fx) * rig.baseline / (value + rig.doffs);
  }

  /// +∞ if it has no number: for an overflowed depth, and for NaN.
  [[nodiscard]] double operator()(double value, double i, double j) const {
    if (from == to) return value;
    if (!std::isfinite(value)) return infinity;
    const double z = planar(value, i, j);
    if (to == DepthQuantity::planar_depth) return z;
    if (to == DepthQuantity::ray_distance) return z * stretch_at(camera, i, j);
    return std::isfinite(z) ? std::abs(camera.projection.fx) * rig.baseline / z - rig.doffs
                            : infinity;
  }
};

StereoRig checked(const Camera& camera, const std::optional<StereoRig>& rig) {
  if (!rig || !(rig->baseline > 0) || !std::isfinite(rig->baseline) || !std::isfinite(rig->doffs))
    throw UsageError("disparity needs a baseline that is a positive number");
  if (is_orthographic(camera.projection))
    throw UsageError("there is no disparity between orthographic views");
  return *rig;
}

/// Background, and what has no number, is +∞.
template <class T>
Samples<T> converted(const Samples<T>& values, const std::vector<std::uint8_t>& surface,
                     std::size_t width, const Converter& convert) {
  Samples<T> result(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t column = k % width, row = k / width;
    result[k] =
        surface[k] == 0
            ? static_cast<T>(infinity)
            : static_cast<T>(convert(static_cast<double>(values[k]), static_cast<double>(column),
                                     static_cast<double>(row)));
  }
  return result;
}

/// The default background of the result.
double usual_background(const DepthMap& map, DepthQuantity from, DepthQuantity to) {
  if (to == DepthQuantity::disparity) return 0;
  if (from == DepthQuantity::disparity) return infinity;
  return declared_background(map).value_or(infinity);
}

}  // namespace

std::array<double, 3> point_at(const Camera& camera, double i, double j, double z) {
  const StandardArithmetic standard;
  // (i + ½) − (c + ½ − pixel_centre) = i − c + pixel_centre
  const double y =
      (j - camera.projection.cy + camera.projection.pixel_centre) / camera.projection.fy;
  const double x =
      (i - camera.projection.cx + camera.projection.pixel_centre - camera.projection.skew * y) /
      camera.projection.fx;
  if (is_orthographic(camera.projection)) return {x, y, z};
  return {x * z, y * z, z};
}

std::string_view name_of(DepthQuantity quantity) {
  switch (quantity) {
    case DepthQuantity::planar_depth:
      return "Z";
    case DepthQuantity::ray_distance:
      return "distance";
    case DepthQuantity::disparity:
      return "disparity";
  }
  return "Z";
}

namespace {

/// Why a map of a lens is not converted, and what to do instead.
std::string_view no_lens(DepthQuantity to) {
  switch (to) {
    case DepthQuantity::planar_depth:
      return "a map is not converted with it; render the channel Z instead";
    case DepthQuantity::ray_distance:
      return "a map is not converted with it; render the channel distance instead";
    case DepthQuantity::disparity:
      return "a disparity is of images without distortion; undistort them, and render without the "
             "lens";
  }
  return computes_on_straight_edges;
}

}  // namespace

DepthMap convert_quantity(const DepthMap& map, DepthQuantity from, DepthQuantity to,
                          const Camera& camera, const std::optional<StereoRig>& rig,
                          std::optional<double> background) {
  const StandardArithmetic standard;
  require_valid(map);
  require_valid(camera);
  require_straight(camera, no_lens(to));
  const std::string name(name_of(from));
  const ImageChannel* source = map.find(name);
  if (!source) throw missing_channel(map, name);
  Converter convert{from, to, camera, {}};
  if (from == DepthQuantity::disparity || to == DepthQuantity::disparity)
    convert.rig = checked(camera, rig);

  const std::vector<std::uint8_t> surface = surface_mask(map, *source);
  DepthMap result = map;
  result.channels.clear();
  result.png_scale.reset();
  result.texts.erase(background_text);
  if (const auto* floats = std::get_if<Samples<float>>(&source->values))
    result.channels.push_back(
        {std::string(name_of(to)), converted(*floats, surface, map.width, convert)});
  else if (const auto* doubles = std::get_if<Samples<double>>(&source->values))
    result.channels.push_back(
        {std::string(name_of(to)), converted(*doubles, surface, map.width, convert)});
  else
    throw UsageError("channel '" + name + "' holds codes: decode them first");
  const double value = background.value_or(usual_background(map, from, to));
  return value == infinity ? result : with_background(std::move(result), value);
}

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
    throw InputError(
        "the codes carry no scale (fathom:scale), so their depth is not known; give 'fathom "
        "convert' one by --png-scale, e.g. 1000 (in Python fathom.Map({'Z': codes}, scale=1000))");
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

/// The integer nearest to a·b, ties to even; nullopt if it is above 65535, 0 if a·b < 0.
///
/// a·b = p + e exactly (two_product() needs a·b ≥ 1/4 for that). p and 1/2 are multiples of ulp(p),
/// and |e| ≤ ulp(p)/2: only if p is half-way between two integers may e change the nearest one.
std::optional<std::uint16_t> rounded_product(double a, double b) {
  if (!(a * b >= 0.25)) return 0;
  if (a * b > 65536) return std::nullopt;
  const auto [p, e] = two_product<true>(a, b);
  double nearest = std::nearbyint(p);
  if (p - nearest == 0.5 && e > 0) ++nearest;
  if (p - nearest == -0.5 && e < 0) --nearest;
  if (nearest > 65535) return std::nullopt;
  return static_cast<std::uint16_t>(nearest);
}

/// How many surfaces lie beyond the codes is counted where that is no fault.
Samples<std::uint16_t> encode(const DepthMap& map, const ImageChannel& channel, double scale,
                              std::uint64_t* beyond) {
  const Samples<double> depths = as_floating_point<double>(map, channel);
  const std::vector<std::uint8_t> surface = surface_mask(map, channel);
  Samples<std::uint16_t> codes(depths.size());
  for (std::size_t k = 0; k < depths.size(); ++k) {
    if (!surface[k]) continue;
    std::optional<std::uint16_t> code;
    if (std::isfinite(depths[k])) code = rounded_product(scale, depths[k]);
    if (!code && beyond && depths[k] > 0) {
      ++*beyond;
      continue;
    }
    if (!code || *code == 0)
      throw OutputError(image::place_of_pixel(k, map.width) + "depth " + std::to_string(depths[k]) +
                        " times the scale " + std::to_string(scale) +
                        " does not fit the codes 1 to 65535");
    codes[k] = *code;
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
  // The background of codes is 0; when codes become depths it is +∞.
  const bool from_codes = std::holds_alternative<Samples<std::uint16_t>>(channel.values);
  if (from_codes || type == StoredType::scaled_unorm16) result.texts.erase(background_text);
  // Widening keeps the stored values, so the declared background is rounded as they were.
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
