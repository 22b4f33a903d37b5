#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/study/study.h"
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

// Too few samples in time, and what helps: scenes that move, drawn by the pipeline.

/// A wheel of 12 spokes that turns by so many degrees a picture.
struct WheelSeen {
  double rate;
  /// By how much it seems to turn, read off pairs of pictures, from −15 to 15 degrees; nothing if
  /// the pictures hold no spokes.
  double apparent;
  double alias;  ///< the rate less the nearest multiple of 30
  /// The difference of bright and dark that is left when the shutter is open from each picture to
  /// the next, over that of the wheel at rest; and what the integral over that time leaves of it.
  double contrast, sinc;
};

/// Mean errors of N pictures against the integral over time, of a square that moves by 3 pixels.
struct TimeError {
  int pictures;
  double centres;  ///< temporal:N, against the integral at the centres of pixels
  double areas;    ///< temporal-area:N, against that over whole pixels
};

/// Errors of sixteen pictures with history, of a star that moves by so many pixels a picture,
/// against the exact picture at the last time.
struct HistoryError {
  double step;
  double none, taa, unlimited, unmoved, neither;
};

struct TemporalStudy {
  std::vector<WheelSeen> wheels;
  std::vector<TimeError> times;
  std::vector<HistoryError> histories;
  std::vector<StudyFile> pictures;
};

TemporalStudy measure_temporal(const std::function<void(double)>& tick);

/// A row of it each.
WheelSeen wheel_seen(double rate);
TimeError time_error(int pictures);
HistoryError history_error(double step);

}  // namespace fathom::studies
