#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "fathom/camera/camera.h"
#include "fathom/image/channel_table.h"
#include "fathom/image/depth_map.h"

/// Conversions of maps that are already written, from their stored, rounded values: the results are
/// rounded twice, unlike channels that are rendered. Computed in binary64, then rounded to nearest,
/// ties to even, to the type of the channel.
namespace fathom {

/// The point seen at the centre of pixel (i, j) at planar depth `z`; camera frame, scene units.
///   perspective    y' = (j + ½ − cy')/fy, x' = (i + ½ − cx' − skew·y')/fx, point (x'·z, y'·z, z)
///   orthographic   (x', y', z)
std::array<double, 3> point_at(const Camera& camera, double i, double j, double z);

enum class DepthQuantity { planar_depth, ray_distance, disparity };
inline constexpr std::array all_depth_quantities{
    DepthQuantity::planar_depth, DepthQuantity::ray_distance, DepthQuantity::disparity};
/// The name of the channel that holds it: "Z", "distance" or "disparity".
std::string_view name_of(DepthQuantity quantity);

/// A rectified stereo pair: disparity = |fx|·baseline / Z − doffs (Middlebury's calib.txt).
/// Unit     baseline: scene units; doffs and disparities: pixels.
struct StereoRig {
  double baseline = 0;
  double doffs = 0;
};

/// Returns a map with one channel: `to`, computed from the map's channel `from`, of the same type,
/// with the map's texts. Pixels without a surface (surface_mask()) become `background`; so do NaN
/// and overflowed depths (+∞). The default background is 0 for disparity, as in most data sets, and
/// otherwise the background that the map declares (surface.h), or +∞. A disparity of +∞ is
/// Middlebury's "unknown".
///   ray distance   Z·√(1 + x'² + y'²) with x', y' as in point_at() (Z itself if orthographic)
/// Fails    UsageError if the channel `from` is missing or holds codes, if disparity is requested
///          without a rig, with baseline ≤ 0, or with an orthographic camera, or if the background
///          is invalid (with_background); InputError if the map or the camera has a fault, and,
///          naming the pixel, if a disparity plus doffs is negative (no point has it); OutputError,
///          naming the pixel, if a surface has the value of the background: with doffs or in
///          binary32, a disparity can be 0.
DepthMap convert_quantity(const DepthMap& map, DepthQuantity from, DepthQuantity to,
                          const Camera& camera, const std::optional<StereoRig>& rig = std::nullopt,
                          std::optional<double> background = std::nullopt);

/// Returns a map with only `channel` (empty: Z, or else the only channel), stored as `type`.
///   to binary32           rounded to nearest even; from codes, code / scale
///   to binary64           widened; from codes, code / scale rounded once
///   to scaled_unorm16     code = round-half-even(scale·D), computed exactly; background is 0.
///                         `scale` is required. Where `beyond_is_none`, a surface whose code would
///                         be above 65535 gets 0, and codes_beyond counts it.
/// Fails    OutputError, naming the pixel, if a depth's code would be 0 or above 65535 (as for an
///          overflowed depth); UsageError if the channel is missing or ambiguous or does not hold
///          depth, or scale is not a positive number; InputError if the map has a fault or codes
///          carry no scale.
DepthMap with_storage(const DepthMap& map, const std::string& channel, StoredType type,
                      std::optional<double> scale = std::nullopt, bool beyond_is_none = false);

}  // namespace fathom
