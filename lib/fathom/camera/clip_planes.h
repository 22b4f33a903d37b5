#pragma once

#include "fathom/camera/camera.h"

namespace fathom {

/// Whether the camera has the near and far between which window depths are defined: a finite far
/// and, of a perspective camera, a near that is not its own position.
bool has_clip_planes(const Camera& camera);

}  // namespace fathom
