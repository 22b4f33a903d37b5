#pragma once

#include "fathom/camera/camera.h"

namespace fathom::fast {

/// The depths that count (specification, section 5: D > 0, near ≤ D ≤ far) as a range of q (see
/// ImageVertex), with doubt at its ends: exact q in [inside_least, inside_greatest] certainly
/// counts; q < outside_least or q > outside_greatest certainly does not.
struct DepthRange {
  double inside_least, inside_greatest;
  double outside_least, outside_greatest;

  [[nodiscard]] bool certainly_contains(double q_least, double q_greatest) const {
    return q_least >= inside_least && q_greatest <= inside_greatest;
  }
  [[nodiscard]] bool certainly_misses(double q_least, double q_greatest) const {
    return q_greatest < outside_least || q_least > outside_greatest;
  }
};

DepthRange depth_range(const Camera& camera);

}  // namespace fathom::fast
