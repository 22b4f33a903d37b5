#pragma once

#include <cstdint>
#include <optional>

#include "fathom/fast/setup/setup.h"
#include "fathom/triangle/recent_triangles.h"
#include "fathom/triangle/referee.h"

namespace fathom::fast {

/// Setups of triangles from exact numbers for all samples of an image, one for each thread: each of
/// many tiles needs them.
class ExactSetups {
 public:
  explicit ExactSetups(const PixelBox& image) : image_(image) {}
  const TriangleSetup& of(std::uint32_t number, triangle::Referee& referee, bool perspective) {
    return remembered_.get(number, [&](TriangleSetup& setup) {
      const auto wide = wide_setup(referee, number, image_);
      setup = wide ? *wide : exact_setup(referee.projected(number), perspective, image_);
    });
  }

 private:
  PixelBox image_;
  triangle::RecentTriangles<TriangleSetup, 4096> remembered_;
};

}  // namespace fathom::fast
