#include "fathom/attribution/model_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "fathom/attribution/attribute_and_name.h"
#include "fathom/attribution/model/named_models.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"

namespace fathom::attribution {
namespace {

/// The less, the better.
auto rank(const ModelTrial& trial) {
  const Attribution& found = trial.attribution;
  return std::tuple(found.count(PixelClass::unexplained), found.findings.size(),
                    found.median_relative_width);
}

bool explains_all(const ModelTrial& trial) {
  const Attribution& found = trial.attribution;
  return found.count(PixelClass::unexplained) == 0 && found.findings.empty();
}

std::string evidence_of(const ModelTrial& trial) {
  const Attribution& found = trial.attribution;
  return fmt::format("{}: {} unexplained, {}, bounds {:.2g} of the depth", trial.model.name,
                     text::counted(found.count(PixelClass::unexplained), "pixel"),
                     text::counted(found.findings.size(), "finding"), found.median_relative_width);
}

}  // namespace

ModelChoice chosen_model(const Truth& truth, const OtherMap& other) {
  const StandardArithmetic standard;
  std::vector<ModelTrial> trials;
  const auto try_those = [&](bool of_vtk) {
    for (RendererModel& model : named_models()) {
      if (is_of_vtk(model) != of_vtk || !has_clip_planes_for(model, truth.camera)) continue;
      Attribution found = attribute_and_name(truth, other, model);
      trials.push_back({std::move(model), std::move(found)});
    }
  };
  try_those(false);
  if (std::none_of(trials.begin(), trials.end(), explains_all)) try_those(true);
  ModelChoice choice;
  for (const ModelTrial& trial : trials) choice.evidence.push_back(evidence_of(trial));
  choice.chosen = std::move(*std::min_element(
      trials.begin(), trials.end(),
      [](const ModelTrial& a, const ModelTrial& b) { return rank(a) < rank(b); }));
  return choice;
}

}  // namespace fathom::attribution
