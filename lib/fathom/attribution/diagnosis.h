#pragma once

#include <optional>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/faults/hypotheses.h"

namespace fathom::attribution {

/// Verdict of a model on a map, and the corrected map, if a fault of the whole image was found.
struct Diagnosis {
  Attribution attribution;
  std::optional<Hypothesis> put_right;
};

/// Only the search of attribute_and_name(). `found`: result of attribute() for the same arguments.
/// Needs    a map whose background is known (background.h), and the model of as_recorded().
Diagnosis diagnose(const Truth& truth, const OtherMap& other, const RendererModel& model,
                   Attribution found);

/// The model, with the step of a map of integers as the recorded precision.
RendererModel as_recorded(const RendererModel& model, const OtherMap& other);

}  // namespace fathom::attribution
