#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "apps/study/indistinguishable/depth_order.h"
#include "fathom/depth_format/depth_format.h"
#include "fathom/depth_format/pipeline_model.h"

/// Z-fighting of two parallel surfaces, one a little behind the other, over a patch of the image
/// that is as wide as it is distant.
namespace fathom::studies {

/// The front surface is tilted: over the patch, 1/D goes from (1 + τ/2)/d to (1 − τ/2)/d, for a
/// distance d in the middle and the tangent τ of the tilt, 0 ≤ τ < 2. The back surface is the same,
/// moved back by the separation s along the view: every depth is (1 + s/d) times as large.
struct CoplanarPair {
  double distance;
  double separation;
  double tilt;
};

/// The depth of the front surface at the share t of the way across the patch; exact.
Ratio front_depth(const CoplanarPair& pair, const Ratio& t);
/// The depth of the back surface there; exact.
Ratio back_depth(const CoplanarPair& pair, const Ratio& t);

/// The share of samples at which the back surface wins, in the ideal model. The back surface is
/// drawn first, so it wins if its code is not strictly farther. The `samples` samples of the patch
/// are random but always the same. Depths beyond near or far are clamped.
double fighting_share(const DepthFormat& format, const CoplanarPair& pair, int samples);

/// The same in the pipeline model. Vertices are rounded to binary32 first, and the correct answer
/// is the exact answer for the rounded vertices, even if the back surface is in front then.
double fighting_share_in_pipeline(const PipelineModel& model, const View& view,
                                  const CoplanarPair& pair, int samples);

/// The least separation at which no sample fights: the greatest separation, over the samples, that
/// the format needs behind the front surface. +∞ if no separation before far is enough.
double least_safe_separation(const DepthFormat& format, const CoplanarPair& pair, int samples);

/// A rule of thumb for least_safe_separation(): the greatest of the widths of the format's bins at
/// the start, the middle and the end of the patch, scaled to the middle.
double predicted_safe_separation(const DepthFormat& format, const CoplanarPair& pair);

// Sweeps of the study `z-fighting`: over the distance, for surfaces tilted by 30 degrees, and over
// the angle.

/// Two parallel surfaces between near and far, and the number of samples of each patch.
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
  /// Every angle is measured at each distance.
  std::vector<double> distances;
};

/// From 0 to 55 degrees, in four formats.
std::vector<FightByAngle> fights_by_angle(const AngleSweep& sweep);

}  // namespace fathom::studies
