#pragma once

#include <nlohmann/json_fwd.hpp>

#include "fathom/depth_format/depth_format.h"

namespace fathom::app {

/// Description of the depth format for a map's `fathom.depth_format` and for `render --stats`.
nlohmann::ordered_json json_of(const DepthFormat& format);

}  // namespace fathom::app
