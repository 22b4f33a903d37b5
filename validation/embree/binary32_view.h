#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "fathom/camera/camera.h"

namespace fathom::validation {

/// The image and its viewing rays, each number rounded to binary32.
///
/// Frame    world; u, v in pixels from the top left corner of the image; near and far are depths.
struct Binary32View {
  std::uint32_t width, height;
  float near, far;
  /// f(u, v) = at_corner + u·per_u + v·per_v, evaluated in binary32.
  struct Affine {
    std::array<float, 3> at_corner, per_u, per_v;
    [[nodiscard]] float at(std::size_t k, float u, float v) const {
      return at_corner[k] + u * per_u[k] + v * per_v[k];
    }
  } origin, direction;
};

Binary32View binary32_view(const Camera& camera);

}  // namespace fathom::validation
