#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fathom/image/depth_map.h"

namespace fathom::app {

/// What `fathom info` says of a map: size, and per channel its type, how many pixels show a surface
/// and the range of its finite values there; object names; the texts of the header.
nlohmann::ordered_json describe(const DepthMap& map);
std::string describe_as_text(const DepthMap& map, const std::string& file);

}  // namespace fathom::app
