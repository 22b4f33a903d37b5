#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/faults/deviation.h"
#include "fathom/attribution/faults/hypotheses.h"

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

/// What was fitted as a hypothesis: the truth that the deviating camera sees, the map with the
/// depths put right, a sentence and the estimates.
Hypothesis deviation_hypothesis(const Truth& truth, const OtherMap& other,
                                const RendererModel& model, const FittedDeviation& fit);

}  // namespace fathom::attribution
