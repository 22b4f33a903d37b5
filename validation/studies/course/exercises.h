#pragma once

#include <array>

#include "fathom/depth_format/depth_format.h"
#include "fathom/image/rgb_image.h"
#include "fathom/pipeline/render_pipeline.h"

/// The exercises of the textbooks, a function each: pictures and figures.
namespace fathom::studies {

/// Exercise 1: Bresenham's lines from the middle at the eight multiples of 45 degrees.
RgbImage eight_lines();

/// Exercise 2: the signs of the three edge functions of (50,20), (200,150), (30,180), 256 × 256:
/// red, green and blue where that opposite the first, second and third corner is positive.
RgbImage edge_function_signs();

/// Exercise 3: two tilted surfaces 0.0001 apart along the view at a distance; white where the
/// nearer one wins, red where the farther one does.
struct Fight {
  RgbImage picture;
  double wrong_share = 0;
};
Fight fight(double distance, Storage storage);

/// Exercise 4: a checkerboard quadrangle seen obliquely, and how far its texture coordinates are
/// from the exact ones.
struct Checkerboard {
  RgbImage picture;
  double mean_error = 0, greatest_error = 0;
};
Checkerboard checkerboard(pipeline::Interpolation interpolation);

/// Exercise 5: a cube.
RgbImage cube(pipeline::Shading shading);

/// Exercise 6: pixels with a part of the samples covered, at 1, 2, 4 and 8 samples, and those that
/// the edge cuts exactly.
struct PartialPixels {
  std::array<std::size_t, 4> counted{};
  std::size_t exact = 0;
  std::array<double, 4> mean_error{};  ///< of the coverage of the pixels that the edge cuts
};
PartialPixels partial_pixels();

}  // namespace fathom::studies
