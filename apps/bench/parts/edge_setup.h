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

/// Which centres on the outline belong to a triangle: those on left and top edges, or all.
enum class EdgeRule { half_open, closed };

/// Three edge functions over the pixels of a triangle's bounding box, in whole numbers: at the
/// centre that is x columns and y rows from the box's first pixel,
///   e_k = start[k] + right[k]·x + down[k]·y,
/// positive inside. The pixel is covered where each e_k ≥ least[k], which is 0 for an edge whose
/// centres belong to the triangle and otherwise 1.
/// Unit     (1/256 pixel)²; below 2⁵³ in images of up to 2¹⁷ pixels a side, so exact in binary64.
/// Source   [Pin88]
struct EdgeSetup {
  std::uint32_t number = 0;  ///< of the triangle
  /// Pixels whose centres lie in the bounding box and in the image; not empty.
  std::int32_t first_column = 0, first_row = 0, columns = 0, rows = 0;
  std::array<std::int64_t, 3> start{}, right{}, down{}, least{};
  /// Window depth at the box's first pixel, and by column and row.
  double depth = 0, depth_right = 0, depth_down = 0;

  /// A row of the box as one of the image.
  [[nodiscard]] std::size_t image_row(std::int32_t y) const {
    return static_cast<std::size_t>(first_row) + static_cast<std::size_t>(y);
  }
  /// What a covered pixel is given: from 1 to 251, so that a pixel which one triangle gains does
  /// not hide that another lost it.
  [[nodiscard]] std::uint32_t weight() const { return number % 251 + 1; }
  /// Whether binary32 holds every number on the way to the edge functions in the box. Sums have to
  /// be within 2²⁴: so it is for triangles of up to 8 pixels, and hardly for greater ones.
  [[nodiscard]] bool fits_binary32() const;
};

/// Those of all triangles that have an area and the centre of a pixel in their boxes.
std::vector<EdgeSetup> set_up_edges(const SnappedScene& scene, EdgeRule rule = EdgeRule::half_open);

}  // namespace fathom::bench
