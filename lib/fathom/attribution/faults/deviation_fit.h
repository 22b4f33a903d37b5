#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/faults/deviation.h"
#include "fathom/attribution/faults/hypotheses.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// An estimated deviation of a whole image.
struct FittedDeviation {
  const DeviationSet* set = nullptr;
  Deviation deviation = Deviation::Zero(), standard = Deviation::Zero();
  /// The part of the standard deviations that the residuals show.
  Deviation shown = Deviation::Zero();
  /// Residuals::cost() without and with it.
  double cost_before = 0, cost = 0;
  /// Kinds of other sets of the same size that explain the differences as well.
  std::vector<std::string> alternatives = {};
};

/// Whether a smaller set of parameters with `cost` is as good as a set with the least cost.
bool is_as_good(double cost, double least);

/// From fits, smallest first, whose least cost is `least`: the smallest fit that is as good as the
/// best and significant. Among indistinguishable fits the first in the order of deviation_sets();
/// the others are its alternatives.
std::optional<FittedDeviation> simplest_of(const std::vector<FittedDeviation>& fits, double least);

/// The fit as a hypothesis: the truth of the deviating camera, the map with corrected depths, a
/// sentence and the estimates.
Hypothesis deviation_hypothesis(const Truth& truth, const OtherMap& other,
                                const RendererModel& model, const FittedDeviation& fit);

/// The smallest set of parameters that explains the differences as well as any tried set, by the
/// Gauss-Newton method over the pixels where both maps show a surface, robust against pixels that
/// show different surfaces. Nothing if no set reduces the residuals noticeably.
/// `found`: result of attribute() for the same arguments.
/// Exact    derivatives; estimates are least squares in binary64.
std::optional<FittedDeviation> fitted_deviation(const Truth& truth, const OtherMap& other,
                                                const RendererModel& model,
                                                const Attribution& found);

}  // namespace fathom::attribution
