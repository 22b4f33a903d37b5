#include <cmath>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/image/background.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/convert.h"
#include "fathom/image/surface.h"
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

  /// +∞ where there is no number for it: of an overflowed depth, or a NaN.
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

/// The background of the result where none is asked for.
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

}  // namespace fathom
