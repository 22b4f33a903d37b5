#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "fathom/image/depth_map.h"

namespace fathom::app {

/// Reads the map that a command was given, within --max-memory; no output may take its place.
/// Fails    InputError.
DepthMap read_map_argument(const std::string& file);
/// The same of a file that has been read already.
DepthMap read_map_argument(std::span<const std::byte> bytes, const std::string& file);

}  // namespace fathom::app
