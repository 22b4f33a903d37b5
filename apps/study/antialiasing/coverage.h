#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "apps/study/study.h"
#include "fathom/image/depth_map.h"
#include "fathom/pipeline/output/output_merger.h"
#include "fathom/pipeline/scan/bezier.h"
#include "fathom/scene/scene.h"

/// Coverage by samples against the exact area `A`.
namespace fathom::studies {

/// How far the shares of a pattern are from the exact areas, over the pixels that are partly
/// covered.
struct PatternError {
  std::string pattern;
  std::size_t samples;
  std::uint64_t partial = 0;       ///< pixels with 0 < A < 1
  std::uint64_t seen_partial = 0;  ///< of these, with 0 < share < 1
  double mean = 0, root_mean_square = 0, greatest = 0;
  /// Σ share − Σ A over them, in pixels.
  double bias = 0;
};

/// Exercise 6: the pixels of an edge that are partly covered, exactly and as samples see it.
struct EdgeSeen {
  double slope;
  std::uint64_t partial = 0;
  std::vector<std::uint64_t> seen;  ///< by 1, 2, 4, 8 samples
  /// Root mean square error of each of edge_patterns.
  std::vector<double> root_mean_square;
};

/// Patterns of 4 and of 16 samples, whose errors along an edge are compared.
inline constexpr const char* edge_patterns[] = {"4", "rotated-grid", "regular:2", "16",
                                                "regular:4"};

struct CoverageBySamples {
  std::vector<PatternError> patterns;
  std::vector<EdgeSeen> edges;
};

/// Channel A of the view: the truth that patterns are held against.
DepthMap exact_coverage(const SceneView& view);

/// Fails    UsageError where no pixel of `exact`, which is exact_coverage(view), is partly covered.
CoverageBySamples measure_coverage_by_samples(const SceneView& view, const DepthMap& exact,
                                              const std::function<void(double)>& tick);

// A filled outline of cubic Bézier curves: a bitmap that is enlarged, or the curve drawn anew.

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
