#pragma once

#include <cstdint>
#include <vector>

#include "fathom/image/depth_map.h"

namespace fathom::attribution {

/// What another renderer drew: rows from the top.
struct OtherMap {
  std::uint32_t width = 0, height = 0;
  /// Depths, infinite where nothing was drawn.
  std::vector<double> depths;
  /// The window depths that were stored, exactly; empty where only depths are known.
  std::vector<double> windows;
  /// Numbers of the triangles that are seen, no_surface elsewhere; may be empty.
  std::vector<std::uint32_t> triangles;
};

/// Reads channel `channel` of a map, or the one that holds depths; `id` too where there is one.
/// Fails    InputError where there is none.
OtherMap other_map(const DepthMap& map, const std::string& channel = "");

/// As a map of ours: Z and, where known, id.
DepthMap as_depth_map(const OtherMap& other);

}  // namespace fathom::attribution
