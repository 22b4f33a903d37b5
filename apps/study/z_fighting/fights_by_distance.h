#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fathom/depth_format/depth_format.h"

/// The part of the study `z-fighting` in which the distance is swept: two surfaces, tilted by 30
/// degrees.
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

}  // namespace fathom::studies
