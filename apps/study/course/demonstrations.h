#pragma once

#include <cstdint>
#include <vector>

#include "apps/study/pipeline_scenes.h"
#include "apps/study/study.h"
#include "fathom/image/rgb_image.h"

/// Too few samples in space, and in time.
namespace fathom::studies {

/// The outline of antialiasing/curve.h, evaluated for so many pixels: curve-48.obj; and as the
/// pipeline draws it, one sample at each pixel's centre.
struct DrawnCurve {
  SceneFiles files;
  RgbImage picture;
};
DrawnCurve curve_at(std::uint32_t size);

inline constexpr int wheel_pictures = 8;
/// From one picture to the next; almost 30, the distance of two spokes.
inline constexpr int wheel_degrees = 27;

/// A wheel of 12 spokes, one of them red, in 96 × 96 pixels: wheel.obj, wheel.json; and
/// wheel-motion.json, in which it turns to the right through all pictures, one in each unit of
/// time.
SceneFiles wheel_files();
/// What the pipeline draws of the times 0, 1, …
std::vector<RgbImage> wheel_at_instants();
/// The same with the shutter open until the time of the next picture: means of 16.
std::vector<RgbImage> wheel_with_open_shutter();

// Interpolation along edges, then along scan lines: on a quadrangle its values depend on how the
// quadrangle is turned, on triangles they do not.

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
