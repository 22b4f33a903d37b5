#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/faults/deviation.h"

namespace fathom::attribution {

/// What is off in a whole image, as it was estimated.
struct FittedDeviation {
  const DeviationSet* set = nullptr;
  Deviation deviation = Deviation::Zero(), standard = Deviation::Zero();
  /// Of the standard deviations, what the residuals show.
  Deviation shown = Deviation::Zero();
  /// Residuals::cost() without and with it.
  double cost_before = 0, cost = 0;
  /// Kinds of other sets of the same size that explain the differences as well.
  std::vector<std::string> alternatives = {};
};

/// Whether a smaller set of parameters, which leaves `cost`, is as good as one that leaves `least`.
bool is_as_good(double cost, double least);

/// Of fits, the smallest first, of which the best leaves `least`: the smallest that is as good and
/// that is more than chance. Of several that cannot be told apart, the first in the order of
/// deviation_sets(); the others are its alternatives.
std::optional<FittedDeviation> simplest_of(const std::vector<FittedDeviation>& fits, double least);

}  // namespace fathom::attribution
