#pragma once

#include "fathom/attribution/faults/deviation_fit.h"
#include "fathom/attribution/faults/hypotheses.h"

namespace fathom::attribution {

/// What was fitted as a hypothesis: the truth that the deviating camera sees, the map with the
/// depths put right, a sentence and the estimates.
Hypothesis deviation_hypothesis(const Truth& truth, const OtherMap& other,
                                const RendererModel& model, const FittedDeviation& fit);

}  // namespace fathom::attribution
