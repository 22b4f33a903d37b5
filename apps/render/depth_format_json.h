#pragma once

#include <nlohmann/json_fwd.hpp>

#include "fathom/depth_format/depth_format.h"

namespace fathom::app {

/// What a map says of its depth format in `fathom.depth_format`, and `render --stats` of it.
nlohmann::ordered_json json_of(const DepthFormat& format);

}  // namespace fathom::app
