#pragma once

#include <cstdint>

#include "fathom/image/rgb_image.h"

namespace fathom::studies {

/// A mesh of narrow triangles on the subpixel grid: how often its samples are covered.
struct SharedEdges {
  int bits = 0;
  std::uint64_t triangles = 0, turned_over = 0, without_area = 0;
  std::uint64_t samples = 0;
  std::uint64_t signed_not_one = 0;    ///< samples, counted by orientation
  std::uint64_t unsigned_not_one = 0;  ///< samples, every triangle counted
  std::uint64_t unexplained = 0;       ///< of these, with no triangle that was turned over
  /// Blue: covered once; red: three times, one of them by a triangle that was turned over.
  RgbImage picture;
};
SharedEdges count_shared_edges(int bits);

}  // namespace fathom::studies
