#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/study/study.h"

/// Too few samples in time, and what helps: scenes that move, drawn by the pipeline.
namespace fathom::studies {

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
