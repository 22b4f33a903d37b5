#pragma once

#include <cstdint>

#include "fathom/image/depth_map.h"
#include "fathom/image/error_metrics.h"

namespace fathom {

/// How the depths of a reconstruction agree with the true ones, over all views. Scene units; sums
/// are computed in binary64, in the order of the views and pixels.
struct DepthAgreement {
  std::uint64_t views = 0;
  /// Pixels that show both surfaces, or only the truth, or only the reconstruction.
  std::uint64_t both = 0, only_truth = 0, only_reconstruction = 0;
  /// Over all pixels that show both; `mae` is Depth L1.
  DepthMetrics metrics;
  /// Depth L1 as two published programs compute it: no surface counts as depth 0, and each view has
  /// the same weight, as the mean over
  ///   all its pixels (NICE-SLAM);
  ///   its pixels that show the truth, in views with more than 100 of them (neural_slam_eval).
  /// Source   `src/tools/eval_recon.py` of cvg/nice-slam; `eval_recon.py` of
  ///          JingwenWang95/neural_slam_eval, not_counting_missing_depth
  double l1_of_all_pixels = 0, l1_of_truth_pixels = 0;
  /// The views that the second is a mean of.
  std::uint64_t views_of_truth = 0;
};

/// Adds up views.
class DepthAgreementSum {
 public:
  /// Maps of one size and camera, with Z in binary32 and infinite without a surface, as from
  /// render().
  /// Fails    std::invalid_argument for other maps
  void add(const DepthMap& truth, const DepthMap& reconstruction);
  [[nodiscard]] DepthAgreement result() const;

 private:
  DepthAgreement sums_;
  DepthErrors errors_;
};

}  // namespace fathom
