#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "fathom/image/depth_map.h"

namespace fathom::attribution {

/// The map of another renderer: images of width × height pixels, rows from the top.
struct OtherMap {
  std::uint32_t width = 0, height = 0;
  /// Depths in scene units, infinite where nothing was drawn.
  std::vector<double> depths;
  /// The window depths that were stored, exactly; empty if only depths are known.
  std::vector<double> windows;
  /// Numbers of the visible triangles, or no_surface; may be empty.
  std::vector<std::uint32_t> triangles;
  /// The unchanged values of the map, before background was separated from surfaces; if empty, only
  /// `depths` is known. Integer codes with a scale are stored as depths in scene units.
  std::vector<double> values;
  /// Codes per scene unit of a map of integers, rounded to nearest.
  std::optional<double> code_scale;
};

/// The channel `channel` of a map, or its depth channel; also `id` if the map has it.
/// Fails    InputError if there is no such channel, naming the existing channels, or if it holds
///          integers and the map has no png_scale, so that their unit is unknown.
OtherMap other_map(const DepthMap& map, const std::string& channel = "");

/// As a depth map of Fathom: Z, rounded to binary32, and, if known, id.
DepthMap as_depth_map(const OtherMap& other);

}  // namespace fathom::attribution
