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
  /// The strongest frequency in the picture with one sample per pixel; 0 if the whole picture has
  /// one grey.
  double apparent;
  /// The contrast of the picture at that frequency, relative to the contrast of a correctly visible
  /// grating of the same shape; and the same for the picture by areas.
  double contrast, contrast_by_area;
  /// Mean errors against the integral over each pixel, which has a closed form.
  double error, error_ssaa, error_by_area;
};

/// Gratings up to 1.5 cycles a pixel.
std::vector<GratingSeen> gratings_seen();

/// "grating-0.300"
std::string grating_name(const GratingSeen& grating);

/// The grating of the first 24 pixels in three strips: the grating itself, with eight columns for
/// each pixel; its samples at the pixels' centres; and the signal below half a cycle per pixel that
/// has these samples, which any ideal filter reconstructs. Both frequencies are written above.
/// Fails    OutputError if the font is missing.
RgbImage grating_picture(const GratingSeen& grating);

/// The samples of the grating at all pixels' centres, 0 or 1, as the pipeline draws them.
std::vector<double> grating_samples(double frequency);
/// The value at a place of the band-limited signal through samples one pixel apart, which repeat
/// forever. The first sample lies at ½.
/// Exact    up to rounding to binary64.
double reconstructed(const std::vector<double>& samples, double x);

/// The part of [x, x + 1] that is white in a grating of this frequency that begins with white at 0.
/// Exact    up to rounding to binary64.
double white_part(double frequency, double x);

/// The highest frequency up to which every grating of the table shows its true frequency.
double nyquist_limit(const std::vector<GratingSeen>& gratings);

// Too few samples in time, and remedies: moving scenes, drawn by the pipeline.

/// A wheel of 12 spokes that turns by `rate` degrees per picture.
struct WheelSeen {
  double rate;
  /// The apparent turn, measured from pairs of pictures, from −15 to 15 degrees; NaN if the
  /// pictures show no spokes.
  double apparent;
  double alias;  ///< the rate less the nearest multiple of 30
  /// The contrast that remains if the shutter is open from each picture to the next, relative to
  /// the contrast of the wheel at rest; and the contrast that the integral over that time leaves.
  double contrast, sinc;
};

/// Mean errors of N pictures against the integral over time, of a square that moves by 3 pixels.
struct TimeError {
  int pictures;
  double centres;  ///< temporal:N, against the integral at the centres of pixels
  double areas;    ///< temporal-area:N, against that over whole pixels
};

/// Errors of sixteen pictures with history, of a star that moves by `step` pixels per picture,
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

/// A row of each table.
WheelSeen wheel_seen(double rate);
TimeError time_error(int pictures);
HistoryError history_error(double step);

}  // namespace fathom::studies
