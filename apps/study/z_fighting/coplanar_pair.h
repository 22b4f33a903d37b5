#pragma once

#include "apps/study/indistinguishable/depth_order.h"
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

}  // namespace fathom::studies
