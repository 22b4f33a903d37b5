#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "apps/study/indistinguishable/depth_order.h"
#include "fathom/depth_format/depth_format.h"
#include "fathom/depth_format/pipeline_model.h"

/// Two parallel surfaces, one a little behind the other, seen over a patch of the image as wide as
/// it is distant: what lets the wrong one win.
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
/// That of the back surface.
Ratio back_depth(const CoplanarPair& pair, const Ratio& t);

/// The share of `samples` samples of the patch, spread at random but always the same, at which the
/// back surface wins, being drawn first: its code is not strictly farther. Ideal model. Depths
/// beyond near or far are taken as these.
double fighting_share(const DepthFormat& format, const CoplanarPair& pair, int samples);

/// The same in the pipeline model. Vertices are rounded to binary32 first, and the exact answer is
/// that of the rounded ones; where it has the back surface in front, that is who should win.
double fighting_share_in_pipeline(const PipelineModel& model, const View& view,
                                  const CoplanarPair& pair, int samples);

/// The least separation at which no sample fights: the greatest, over the samples, of what the
/// format needs behind the front surface there. +∞ where no separation will do before far.
double least_safe_separation(const DepthFormat& format, const CoplanarPair& pair, int samples);

/// A rule of thumb for it: the width of the bins of the format at the start, the middle and the end
/// of the patch, scaled to the middle; the greatest of the three.
double predicted_safe_separation(const DepthFormat& format, const CoplanarPair& pair);

// The parts of the study `z-fighting` in which the distance is swept, of two surfaces that are
// tilted by 30 degrees, and the angle.

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
