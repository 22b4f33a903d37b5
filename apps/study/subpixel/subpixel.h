#pragma once

#include <cstdint>
#include <vector>

#include "apps/study/study.h"

/// Triangles drawn as hardware draws them: corners moved to the nearest point of a subpixel grid,
/// coverage decided there by the top-left rule in exact integers.
namespace fathom::studies {

struct SnappedMap {
  std::vector<std::uint32_t> id;  ///< width × height; no_surface
  std::vector<double> depth;
  /// Triangles that reach behind the camera, or too far beside the image for the integers; they are
  /// not drawn.
  std::uint64_t left_out = 0;
};

/// The image with corners at multiples of 2^−bits pixels, 0 ≤ bits ≤ 16.
///
/// Exact    corners are the exact image points rounded to the grid, ties to even; coverage is exact
///          for these. 1/D (perspective; D orthographic) is affine over the moved triangle, exact
///          at its corners; it is computed in binary64, with errors below 2⁻⁴⁰ of it but for
///          slivers. The least depth wins, among equals the lowest number.
SnappedMap draw_snapped(const SceneView& view, int bits);

}  // namespace fathom::studies
