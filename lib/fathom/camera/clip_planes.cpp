#include "fathom/camera/clip_planes.h"

#include <cmath>

namespace fathom {

bool has_clip_planes(const Camera& camera) {
  return std::isfinite(camera.far) && (camera.near > 0 || is_orthographic(camera.projection));
}

}  // namespace fathom
