#pragma once

#include <optional>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/faults/deviation_choice.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// The smallest set of parameters that explains the differences as well as any tried set, by the
/// Gauss-Newton method over the pixels where both maps show a surface, robust against pixels that
/// show different surfaces. Nothing if no set reduces the residuals noticeably.
/// `found`: result of attribute() for the same arguments.
/// Exact    derivatives; estimates are least squares in binary64.
std::optional<FittedDeviation> fitted_deviation(const Truth& truth, const OtherMap& other,
                                                const RendererModel& model,
                                                const Attribution& found);

}  // namespace fathom::attribution
