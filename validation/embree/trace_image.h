#pragma once

#include <embree3/rtcore.h>

#include "validation/embree/binary32_view.h"
#include "validation/embree/embree_tracer.h"

namespace fathom::validation {

/// Traces one ray through each pixel's centre, blocks of pixels in parallel: writes the depths,
/// width × height, rows from the top, infinite where nothing was hit.
void trace_image(RTCScene scene, const Binary32View& view, RayStream stream, float* depths);

}  // namespace fathom::validation
