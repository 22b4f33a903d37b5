#pragma once

#include <cstdint>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// Pixels that hold a depth which a model's storage cannot have held, whatever was drawn: at least
/// so many. A coarse storage allows every surface a wide interval, but only few depths in it.
///
/// Exact    a depth is foreign where no code lies within what decoding and rounding to binary32 may
///          lose of it. Where that is more than a quarter of a code, codes are counted: n codes
///          decode to at most n depths, so of more depths in their range the rest is foreign.
///          0 for models of rays, for reversed and written window depths, and for depths that were
///          recorded in another way; binary32 counts from a window depth of 1/2 on.
std::uint64_t foreign_values(const Camera& camera, const OtherMap& other,
                             const RendererModel& model);

}  // namespace fathom::attribution
