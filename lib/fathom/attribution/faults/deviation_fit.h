#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/faults/deviation.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// What is off in a whole image, as it was estimated.
struct FittedDeviation {
  const DeviationSet* set = nullptr;
  Deviation deviation = Deviation::Zero(), standard = Deviation::Zero();
  /// Residuals::cost() without and with it.
  double cost_before = 0, cost = 0;
  /// Kinds of other sets of the same size that explain the differences as well.
  std::vector<std::string> alternatives = {};
};

/// The smallest set of parameters that explains the differences as well as any of those that are
/// tried, by Gauss and Newton's method over the pixels where both show a surface, robust against
/// those that show others. Nothing where no set makes residuals smaller to speak of.
/// `found`: what attribute() says of the three.
/// Exact    derivatives are; estimates are those of least squares in binary64.
std::optional<FittedDeviation> fitted_deviation(const Truth& truth, const OtherMap& other,
                                                const RendererModel& model,
                                                const Attribution& found);

}  // namespace fathom::attribution
