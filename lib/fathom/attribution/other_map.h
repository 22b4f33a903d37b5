#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/image/depth_map.h"

namespace fathom::attribution {

/// What another renderer drew: images of width × height pixels, rows from the top.
struct OtherMap {
  std::uint32_t width = 0, height = 0;
  /// Depths in scene units, infinite where nothing was drawn.
  std::vector<double> depths;
  /// The window depths that were stored, exactly; empty if only depths are known.
  std::vector<double> windows;
  /// Numbers of the visible triangles, no_surface where there is none; may be empty.
  std::vector<std::uint32_t> triangles;
  /// What the map holds as it is, before background was told from surfaces; may be empty, then
  /// `depths` is all that is known. Of integer codes with a scale, depths in scene units.
  std::vector<double> values;
  /// Codes per scene unit of a map of integers, rounded to nearest.
  std::optional<double> code_scale;
};

/// The channel `channel` of a map, or the one that holds depths; also `id` if there is one.
/// Fails    InputError if there is no such channel, naming those that there are, or if it holds
///          integers and the map has no png_scale: what their unit is, nothing tells.
OtherMap other_map(const DepthMap& map, const std::string& channel = "");

/// As a map of ours: Z, rounded to binary32, and, if known, id.
DepthMap as_depth_map(const OtherMap& other);

}  // namespace fathom::attribution
