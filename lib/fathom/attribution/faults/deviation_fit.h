#pragma once

#include <optional>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/faults/deviation_choice.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// The smallest set of parameters that explains the differences as well as any of those that are
/// tried, by Gauss and Newton's method over the pixels where both show a surface, robust against
/// those that show others. Nothing where no set makes residuals smaller to speak of.
/// `found`: what attribute() says of the three.
/// Exact    derivatives are; estimates are those of least squares in binary64.
std::optional<FittedDeviation> fitted_deviation(const Truth& truth, const OtherMap& other,
                                                const RendererModel& model,
                                                const Attribution& found);

}  // namespace fathom::attribution
