#pragma once

#include <optional>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/faults/hypotheses.h"

namespace fathom::attribution {

/// What a model makes of a map, and the map with its fault put right, where a fault of the whole
/// image was found.
struct Diagnosis {
  Attribution attribution;
  std::optional<Hypothesis> put_right;
};

/// The search of attribute_and_name() alone. `found`: what attribute() says of the three.
/// Needs    a map whose background is known (background.h), and the model of as_recorded().
Diagnosis diagnose(const Truth& truth, const OtherMap& other, const RendererModel& model,
                   Attribution found);

/// The model, with the step of a map of integers as what is recorded.
RendererModel as_recorded(const RendererModel& model, const OtherMap& other);

}  // namespace fathom::attribution
