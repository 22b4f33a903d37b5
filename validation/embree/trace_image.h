#pragma once

#include <embree3/rtcore.h>

#include "validation/embree/binary32_view.h"
#include "validation/embree/embree_tracer.h"

namespace fathom::validation {

/// Images of width × height pixels, rows from the top: depths, infinite where nothing was hit, and,
/// unless null, the numbers of the triangles, no_surface there.
struct TracedImages {
  float* depths = nullptr;
  std::uint32_t* triangles = nullptr;
};

/// Traces one ray through each pixel's centre, blocks of pixels in parallel.
void trace_image(RTCScene scene, const Binary32View& view, RayStream stream,
                 const TracedImages& images);

}  // namespace fathom::validation
