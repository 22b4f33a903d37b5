#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "fathom/camera/camera.h"
#include "validation/embree/embree_tracer.h"

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
