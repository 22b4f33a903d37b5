#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "fathom/fast/coverage/pixel_area.h"
#include "fathom/fast/setup/setup.h"

// Affine functions that are positive inside a triangle, in pixels from a tile's top left corner.
// Their bounds cover all values that users compute from them at pixels of the tile.
namespace fathom::fast {

/// Points (x, y) with left ≤ x ≤ right, top ≤ y ≤ bottom, where a function is looked at.
struct Rectangle {
  double left, right, top, bottom;
};

/// Whether c + a·x + b·y is certainly negative all over a rectangle: at the corner where it is
/// greatest it is below −error. bins/boxes.cpp does the same for several functions at once.
/// Needs    an error that bounds the error of the value as it is computed here.
inline bool is_certainly_negative(double a, double b, double c, double error,
                                  const Rectangle& over) {
  const double x = a > 0 ? over.right : over.left, y = b > 0 ? over.bottom : over.top;
  return c + a * x + b * y < -error;
}

/// The edge functions of a triangle with usable corners, in an order that makes its area positive.
std::array<UncertainHalfPlane, 3> edges_over_tile(const std::array<ImageVertex, 3>& corners,
                                                  const PixelBox& tile);

/// The edge functions, and q less the ends of the range of depths.
struct TileFunctions {
  std::array<UncertainHalfPlane, 5> functions;
  std::uint32_t count = 0;
};
/// Needs    a setup of exact_setup() for the samples of the tile.
TileFunctions functions_over_tile(const TriangleSetup& exact_setup, const DepthRange& range);

struct ValuesInPixel {
  double least, greatest;
};
inline ValuesInPixel values_in_pixel(const UncertainHalfPlane& f, double column, double row) {
  const double at_centre = f.c + f.a * (column + 0.5) + f.b * (row + 0.5);
  const double half = (std::abs(f.a) + std::abs(f.b)) / 2;
  return {at_centre - half, at_centre + half};
}

/// Whether the functions are certainly not all positive anywhere in a pixel because of two of them:
/// a sum of these that depends on the row alone, or on the column, is negative. This finds
/// triangles beyond a side of the pixel that no side of their own separates from it.
bool certainly_misses_pixel(std::span<const UncertainHalfPlane> functions, double column,
                            double row);

}  // namespace fathom::fast
