#pragma once

#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/pixels/pixel_judge.h"

namespace fathom::attribution {

/// Numbers of all pixels, in the order of the pixels whatever threads judged them.
Attribution summary_of(const std::vector<PixelResult>& pixels, const Truth& truth);

}  // namespace fathom::attribution
