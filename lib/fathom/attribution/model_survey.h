#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// What a model makes of a sample of a map's rows.
struct ModelSurvey {
  RendererModel model;
  /// Pixels of the sample that are unexplained; those of the whole map that hold what the model's
  /// storage cannot (foreign_values.h).
  std::uint64_t unexplained = 0, foreign = 0;
  /// Part of the bands with surfaces that the sample is.
  double share = 1;
  /// Median width of the bounds, relative to the depth.
  double width = 0;

  /// A model that leaves a pixel of the sample open does not explain the map.
  [[nodiscard]] bool may_explain_all() const { return unexplained == 0 && foreign == 0; }
  /// Estimate for the whole map of the pixels that the model does not explain. A foreign pixel
  /// counts as one unexplained pixel: a stray value is foreign to the storage of the right model,
  /// too.
  [[nodiscard]] double estimated_unexplained() const {
    return static_cast<double>(foreign) + static_cast<double>(unexplained) / share;
  }
};

ModelSurvey surveyed(const Truth& truth, const OtherMap& other, const RendererModel& model);

/// "gl-unorm24: 12 pixels of a sample unexplained".
std::string text_of(const ModelSurvey& survey);

}  // namespace fathom::attribution
