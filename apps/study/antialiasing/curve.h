#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fathom/pipeline/output/output_merger.h"
#include "fathom/pipeline/scan/bezier.h"
#include "fathom/scene/scene.h"

/// A filled outline of cubic Bézier curves: a bitmap that is enlarged, or the curve drawn again.
namespace fathom::studies {

/// A heart in the unit square, of four curves; it runs clockwise as seen with y down.
std::vector<pipeline::CubicBezier> heart();

/// The heart in `size` by `size` pixels, for window_camera(): as triangles, of chords that keep
/// `within` so much of a pixel.
Scene heart_scene(std::uint32_t size, double within);

/// How much of each pixel lies inside of an outline, `size` by `size` pixels.
/// Computed from chords that are at most 10⁻⁶ of a pixel away from the curves, by adding up, for
/// each of them, the area to its right in its pixel, and what it adds to all pixels to the right:
/// an algorithm of its own, with no triangle and no sample in it.
pipeline::ColourImage outline_areas(const std::vector<pipeline::CubicBezier>& outline,
                                    std::uint32_t size);

/// The outline, enlarged `magnification` times from 24 pixels.
struct CurveError {
  int magnification;
  std::size_t chords;  ///< that keep within a tenth of a pixel
  /// The area of the polygon of chords over that of the outline, less 1.
  double area;
  /// Mean errors: of the polygon by areas, and of the bitmap of 24 pixels, by areas too, with each
  /// of its pixels enlarged.
  double anew, enlarged;
};
CurveError curve_error(int magnification);

/// The two pictures.
struct CurvePictures {
  pipeline::ColourImage enlarged, anew;
};
CurvePictures curve_pictures(int magnification);

}  // namespace fathom::studies
