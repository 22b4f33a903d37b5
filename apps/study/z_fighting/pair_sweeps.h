#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fathom/depth_format/depth_format.h"

/// The parts of the study `z-fighting` in which the distance is swept, of two surfaces that are
/// tilted by 30 degrees, and the angle.
namespace fathom::studies {

/// Two parallel surfaces between near and far, as many samples of each patch.
struct SurfacePair {
  double near, far, separation;
  int samples;
};

/// One format at one distance.
struct FightByDistance {
  DepthFormat format;
  double distance;
  /// Share of samples where the wrong surface wins.
  double ideal;
  /// In the pipeline model, for projections, by how the matrices are applied.
  std::optional<double> separate, premultiplied;
  double safe, predicted;  ///< least safe separation
};
/// In every format.
std::vector<FightByDistance> fights_by_distance(const SurfacePair& surfaces,
                                                const std::vector<double>& distances,
                                                const std::function<void(double)>& tick);

/// The share of samples where the wrong surface wins, ideal model, over distance and separation.
struct FightsByDistanceAndSeparation {
  /// Evenly spaced: distances from 2·near to far/2, separations from 10⁻⁸ to 1.
  std::vector<double> log_distances, log_separations;
  std::vector<double> shares;  ///< separations × distances, row by row
};
FightsByDistanceAndSeparation fights_by_distance_and_separation(const DepthFormat& format,
                                                                const SurfacePair& surfaces);

/// The two surfaces, tilted by an angle from facing the camera.
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
