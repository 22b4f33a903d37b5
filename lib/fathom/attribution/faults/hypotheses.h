#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fathom/attribution/attribution.h"

namespace fathom::attribution {

/// A possible fault of a whole image: a model and a map in which this fault is corrected.
struct Hypothesis {
  /// As of a Finding.
  std::string kind, text;
  RendererModel model;
  OtherMap map;
  /// Set if it differs from the truth of the comparison.
  std::optional<Truth> truth = {};
  /// As of a Finding.
  std::vector<Estimate> estimates = {};
  std::vector<std::string> alternatives = {};
};

/// Makes a hypothesis when it is tried; nothing if it does not apply.
using MakeHypothesis = std::function<std::optional<Hypothesis>()>;

/// All hypotheses, in the order of trial. The arguments outlive them. `found` is the result of
/// attribute() for them.
std::vector<MakeHypothesis> hypotheses(const Truth& truth, const OtherMap& other,
                                       const RendererModel& model, const Attribution& found);

/// The hypotheses for a camera with a lens: the lens is left out, only the vertices are bent by it,
/// the map of a camera without it is looked up, the samples lie half a pixel off; then those of
/// lens_convention_hypotheses(). The arguments outlive them.
/// Needs    a truth with a lens.
std::vector<MakeHypothesis> lens_hypotheses(const Truth& truth, const OtherMap& other,
                                            const RendererModel& model);

/// A part of these: the numbers of the lens are read by another convention or applied in the wrong
/// direction, or its inverse stops early. The arguments outlive them.
/// Needs    a truth with a lens.
std::vector<MakeHypothesis> lens_convention_hypotheses(const Truth& truth, const OtherMap& other,
                                                       const RendererModel& model);

}  // namespace fathom::attribution
