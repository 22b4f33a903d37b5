#pragma once

#include <algorithm>
#include <cstdint>

#include "fathom/camera/camera.h"

namespace fathom::bench {

/// In pixels.
struct ImageSize {
  std::uint32_t width, height;
  [[nodiscard]] std::uint32_t least() const { return std::min(width, height); }
};

/// At the origin, looking along +z, with square pixels and the principal point in the middle of the
/// image; the focal length is in heights of the image.
Camera simple_camera(const ImageSize& size, double focal = 1.2);

}  // namespace fathom::bench
