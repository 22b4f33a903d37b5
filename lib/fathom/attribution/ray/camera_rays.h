#pragma once

#include <array>

#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// The viewing rays of a camera as affine functions of the image position: (u, v) shows the points
/// origin + D·direction, so that the parameter along the ray is the depth D.
///
/// Frame    world, scene units; (u, v) in pixels, (0, 0) the top left corner of the image.
/// Exact    rounded to binary64 several times: good enough for renderers that compute in binary32.
struct CameraRays {
  /// f(u, v) = at_corner + u·per_u + v·per_v
  struct Affine {
    std::array<double, 3> at_corner{}, per_u{}, per_v{};
  };
  Affine origin, direction;
};

CameraRays camera_rays(const Camera& camera);

}  // namespace fathom::attribution
