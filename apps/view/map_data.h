#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "apps/view/page.h"

namespace fathom::view {

inline constexpr std::uint32_t tile_size = 512;

/// Writes the planes of a map as script elements and returns what the page has to know of it: size,
/// levels, camera, and of each channel its name, type, kind, names and which plane shows where it
/// has values. Level n has every 2ⁿ-th pixel. A tile is the element `PREFIX-PLANE-LEVEL-NUMBER`;
/// planes are `c0`, `c1`, … of channels and `k0`, … of masks.
nlohmann::json write_planes(const ViewedMap& viewed, const std::string& prefix, const Sink& sink);

}  // namespace fathom::view
