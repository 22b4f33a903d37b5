#pragma once

#include <optional>
#include <vector>

#include "fathom/depth_format/depth_format.h"

/// The part of the study `z-fighting` in which the angle is swept: how far the two surfaces are
/// tilted from facing the camera.
namespace fathom::studies {

struct FightByAngle {
  DepthFormat format;
  double degrees, distance;
  /// Share of samples where the wrong surface wins.
  double ideal;
  std::optional<double> premultiplied;  ///< in the pipeline model, for projections
  double safe, predicted;               ///< least safe separation
};

struct AngleSweep {
  double near, far, separation;
  int samples;
  /// At each of which every angle is measured.
  std::vector<double> distances;
};

/// From 0 to 55 degrees, in four formats.
std::vector<FightByAngle> fights_by_angle(const AngleSweep& sweep);

}  // namespace fathom::studies
