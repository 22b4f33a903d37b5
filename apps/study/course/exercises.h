#pragma once

#include <array>
#include <vector>

#include "apps/study/pipeline_scenes.h"
#include "fathom/depth_format/depth_format.h"

/// The exercises of the textbooks, a function each: pictures and figures.
namespace fathom::studies {

/// Exercise 1: eight lines from the middle of 65 × 65 pixels at the multiples of 45 degrees, drawn
/// by the pipeline.
SceneFiles eight_lines_files();
RgbImage eight_lines(pipeline::WireLine algorithm);

/// Exercise 2: the three edge functions of (50,20), (200,150), (30,180) at the centres of 256 × 256
/// pixels, row by row: those of the edges opposite the first, second and third corner. Exact.
std::array<std::vector<double>, 3> edge_function_values();
/// Their signs: red, green and blue where the first, second and third is positive.
RgbImage edge_function_signs();

/// Exercise 3: two tilted surfaces 0.0001 apart along the view at a distance; white where the
/// nearer one wins, red where the farther one does.
SceneFiles fight_files(double distance);
struct Fight {
  RgbImage picture;
  double wrong_share = 0;
};
Fight fight(double distance, Storage storage,
            pipeline::Precision precision = pipeline::Precision::binary32);
/// Of the surface in front against the plane of the picture, in degrees.
double tilt_of_fight();
/// The separation of the surfaces in steps of unorm16, if it were one of window depths.
double steps_of_unorm16();

/// Exercise 4: a checkerboard quadrangle seen obliquely, and how far its texture coordinates are
/// from the exact ones.
SceneFiles checkerboard_files();
struct Checkerboard {
  RgbImage picture;
  double mean_error = 0, greatest_error = 0;
};
Checkerboard checkerboard(pipeline::Interpolation interpolation);

/// Exercise 6: the pixels of a half plane's edge that are partly covered in the pipeline's pictures
/// with 1, 2, 4 and 8 samples, and those that the edge cuts exactly.
SceneFiles half_plane_files();
struct PartialPixels {
  std::array<std::size_t, 4> counted{};
  std::size_t exact = 0;
  std::array<double, 4> mean_error{};  ///< of the coverage of the pixels that the edge cuts
  std::array<RgbImage, 4> pictures;    ///< white by the share of the samples
  RgbImage exact_picture;              ///< by the area; of the exact engine
};
PartialPixels partial_pixels();

}  // namespace fathom::studies
