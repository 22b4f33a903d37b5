#pragma once

#include <vector>

#include "apps/doctor/data_set.h"
#include "fathom/attribution/robust_statistics.h"

namespace fathom::doctor {

/// How stored depths deviate from exact depths, relative to these.
struct Noise {
  attribution::Location deviation;
  /// The share of neighbours in an image whose deviations lie on the same side of the median: one
  /// half if each pixel deviates by itself, near 1 if a wrong camera causes the deviations.
  double same_side = 1;
  /// The share of the pixels with a stored depth that also have an exact depth.
  double compared = 0;
};

/// `depth_scale`: the stored depths of a scene unit.
/// Needs    pixels in the order of DataSet::pairs().
Noise noise_of(const std::vector<Pair>& pairs, double depth_scale);

/// Whether the depths are right except for noise of each pixel by itself, however large.
bool is_independent(const Noise& noise);

}  // namespace fathom::doctor
