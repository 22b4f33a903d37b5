#pragma once

#include "fathom/image/deep_map.h"

namespace fathom {

/// What can be drawn of a deep map, with its names and texts: `samples`, the number of samples at
/// each pixel; `Z`, `ZBack` and `id` of the first, the nearest; and `A`, the sum of their areas.
/// Background as of rendered maps.
/// Needs    as many counts as pixels, and as many samples as they say.
DepthMap flat_map(const DeepMap& deep);

}  // namespace fathom
