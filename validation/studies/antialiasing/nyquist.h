#pragma once

#include <vector>

namespace fathom::studies {

/// Black and white bars of equal width, drawn by the pipeline as triangles; frequencies in cycles a
/// pixel.
struct GratingSeen {
  double frequency;
  /// The strongest frequency in the picture with one sample a pixel; 0 if all of it is of one grey.
  double apparent;
  /// The difference of bright and dark in it at that frequency, over that of a grating of the same
  /// shape that is seen as it is; and in the picture by areas.
  double contrast, contrast_by_area;
  /// Mean errors against the integral over each pixel, which has a closed form.
  double error, error_ssaa, error_by_area;
};

/// Gratings up to 1.5 cycles a pixel.
std::vector<GratingSeen> gratings_seen();

/// The part of [x, x + 1] that is white in a grating of this frequency, white from 0 on.
/// Exact    up to rounding to binary64.
double white_part(double frequency, double x);

/// The highest frequency up to which every grating of the table is seen as it is.
double nyquist_limit(const std::vector<GratingSeen>& gratings);

}  // namespace fathom::studies
