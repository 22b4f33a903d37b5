#pragma once

#include <optional>
#include <vector>

#include "apps/doctor/data_set.h"

namespace fathom::doctor {

/// How the stored depths choose between two predictions of each pixel.
struct Preference {
  /// Where the stored depths lie between the predictions: 0 at the first, 1 at the second; the
  /// weighted median over pixels, with the distance of the predictions as weight.
  double place = 0;
  /// The share of blocks whose own place is nearer to the second.
  double agreeing_blocks = 0;
  /// The sum of the residuals of the second prediction, each limited to a few differences of the
  /// predictions, relative to the sum of the first.
  double residuals = 1;
};

/// Nothing if too few pixels distinguish the predictions. Noise whose median is 0 moves the place
/// of neither: with noise the place is 0 or 1 with a deviation that falls with the number of
/// pixels, and the blocks show whether it is certain.
/// Needs    pixels in the same order.
std::optional<Preference> preference(const std::vector<Pair>& first, double first_scale,
                                     const std::vector<Pair>& second, double second_scale);

/// Whether the second prediction is right and the first is not.
bool is_certain(const Preference& preference);

}  // namespace fathom::doctor
