#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "validation/scenes/scenes.h"

namespace fathom::bench {

/// Steps of the grid of corners in a pixel, as the pipeline has them by default: 8 bits.
inline constexpr int snapped_bits = 8;
inline constexpr std::int64_t steps_per_pixel = std::int64_t{1} << snapped_bits;

/// A place in the window, in steps of the grid; y grows down, the centre of pixel (0, 0) is at
/// (128, 128).
struct GridPlace {
  std::int64_t x = 0, y = 0;
  friend bool operator==(const GridPlace&, const GridPlace&) = default;
};

/// A triangle as it reaches scan conversion: clipped to the window, corners on the grid.
struct SnappedTriangle {
  std::array<GridPlace, 3> corners;
  /// Window depths of the corners, near 0, far 1.
  std::array<double, 3> depths{};
};

/// What the kernels draw.
struct SnappedScene {
  std::uint32_t width = 0, height = 0;
  std::vector<SnappedTriangle> triangles;
};

/// The scene up to the window, by the pipeline's geometry stages in binary64.
/// Fails    InputError as the pipeline.
SnappedScene snapped(const BenchScene& bench);

}  // namespace fathom::bench
