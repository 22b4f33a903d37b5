#pragma once

#include "fathom/camera/camera.h"
#include "fathom/image/depth_map.h"

namespace fathom::triangle {

/// A map to which something is added, or which is looked at again: one of the camera's size.
/// Fails    InputError where the map has a fault (find_fault) or another size.
void require_map_of(const Camera& camera, const DepthMap& map);

}  // namespace fathom::triangle
