#pragma once

#include <vector>

#include "apps/study/study.h"
#include "fathom/image/rgb_image.h"

/// Interpolation along edges, then along scan lines: on a quadrangle its values depend on how the
/// quadrangle is turned, on triangles they do not.
namespace fathom::studies {

/// A square whose corners have the values 0, 1, 0, 0, and the same cut into two triangles along the
/// diagonal whose ends have 0; turned about its middle, the centre of pixel (30, 30) of 61 × 61.
struct TurnedSquare {
  int degrees = 0;  ///< clockwise
  /// The values at the middle: of the square by scan lines; of the triangles by scan lines and by
  /// barycentric coordinates. Computed exactly.
  double square = 0, by_scan_lines = 0, by_weights = 0;
  /// Values of all pixels, from 0 (dark) to 1 (bright) in steps of a tenth.
  RgbImage square_picture, triangles_picture;
};
/// Upright, turned by 45 and by 90 degrees.
std::vector<TurnedSquare> turned_squares();

/// The same as cases for `fathom scan`: squares.jsonl, a line each, and triangles.jsonl, two each.
std::vector<StudyFile> square_files();

}  // namespace fathom::studies
