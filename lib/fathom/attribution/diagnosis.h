#pragma once

#include <optional>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/faults/hypotheses.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// A map whose background was separated from surfaces by its values where the truth has no surface.
struct KnownBackground {
  OtherMap map;
  /// A finding of kind `background`; nullopt if the background is infinite, as in Fathom's maps.
  std::optional<Finding> note;
};

/// The background is the most frequent value of the pixels around which the exact map is empty: the
/// far plane's depth, 0, −1, 1, NaN, …. Returns the map unchanged if there are too few such pixels,
/// if they do not agree, or if the map's values are unknown.
KnownBackground known_background(const Truth& truth, const OtherMap& other);

/// Verdict of a model on a map, and the corrected map, if a fault of the whole image was found.
struct Diagnosis {
  Attribution attribution;
  std::optional<Hypothesis> put_right;
};

/// Only the search of attribute_and_name(). `found`: result of attribute() for the same arguments.
/// Needs    a map whose background is known (known_background()), and the model of as_recorded().
Diagnosis diagnose(const Truth& truth, const OtherMap& other, const RendererModel& model,
                   Attribution found);

/// The model, with the step of a map of integers as the recorded precision.
RendererModel as_recorded(const RendererModel& model, const OtherMap& other);

}  // namespace fathom::attribution
