#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"
#include "fathom/camera/camera_making.h"

/// What is known of a map, made by hand where a renderer would take long to come by it.
namespace fathom::test {

/// A camera of 96 × 72 pixels that looks down at the origin from a distance of 3, near 0.5, far 20.
inline Camera level_camera() {
  Camera camera = look_from({.azimuth = 35, .elevation = 25}, {0.1, -0.05, 0.2}, 3,
                            {.width = 96, .height = 72, .vertical_fov = 45});
  camera.near = 0.5;
  camera.far = 20;
  return camera;
}

/// An image of width × height pixels, each with the depth of its own that `depth(column, row)`
/// says; infinite is background, the rest triangle 0.
template <class Depth>
attribution::Truth truth_of(std::uint32_t width, std::uint32_t height, const Depth& depth) {
  attribution::Truth truth;
  truth.camera.width = width;
  truth.camera.height = height;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      const double d = depth(column, row);
      truth.depths.push_back(d);
      truth.triangles.push_back(d < std::numeric_limits<double>::infinity() ? 0 : no_surface);
    }
  }
  return truth;
}

/// A map that holds what the truth does.
inline attribution::OtherMap same_as(const attribution::Truth& truth) {
  return {.width = truth.camera.width,
          .height = truth.camera.height,
          .depths = truth.depths,
          .values = truth.depths};
}

/// Every pixel is equal, none is explained by the absence of a triangle.
inline attribution::Attribution all_equal(const attribution::Truth& truth) {
  attribution::Attribution found;
  found.classes.assign(truth.depths.size(), attribution::PixelClass::equal);
  found.clues.absent.assign(truth.depths.size(), no_surface);
  found.counts[0] = truth.depths.size();
  return found;
}

inline void set_unexplained(attribution::Attribution& found, std::size_t pixel) {
  --found.counts[static_cast<std::size_t>(found.classes[pixel])];
  found.classes[pixel] = attribution::PixelClass::unexplained;
  ++found.counts[static_cast<std::size_t>(attribution::PixelClass::unexplained)];
}

}  // namespace fathom::test
