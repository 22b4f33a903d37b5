#pragma once

#include <string>
#include <vector>

#include "fathom/image/rgb_image.h"

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

/// "grating-0.300"
std::string grating_name(const GratingSeen& grating);

/// The grating of the first 24 pixels in three strips: as it is, eight columns for each pixel; as
/// its samples at the pixels' centres; and the signal that these samples are those of below half a
/// cycle a pixel, which is what any ideal filter makes of them. With both frequencies in letters
/// above.
/// Fails    OutputError if the font is missing.
RgbImage grating_picture(const GratingSeen& grating);

/// The samples of the grating at all pixels' centres, 0 or 1, as the pipeline draws them.
std::vector<double> grating_samples(double frequency);
/// The band-limited signal through samples one pixel apart, at a place; they repeat for ever. The
/// first sample lies at ½.
/// Exact    up to rounding to binary64.
double reconstructed(const std::vector<double>& samples, double x);

/// The part of [x, x + 1] that is white in a grating of this frequency, white from 0 on.
/// Exact    up to rounding to binary64.
double white_part(double frequency, double x);

/// The highest frequency up to which every grating of the table is seen as it is.
double nyquist_limit(const std::vector<GratingSeen>& gratings);

}  // namespace fathom::studies
