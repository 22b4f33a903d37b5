#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"
#include "fathom/camera/camera.h"

namespace fathom::attribution {

/// Verdict of a model on a sample of a map's rows.
struct ModelSurvey {
  RendererModel model;
  /// Unexplained pixels of the sample; pixels of the whole map with values that the model's storage
  /// cannot hold.
  std::uint64_t unexplained = 0, foreign = 0;
  /// The share of the bands with surfaces that the sample contains.
  double share = 1;
  /// Median width of the bounds, relative to the depth.
  double width = 0;
  /// Whether the bounds exclude something at most pixels of the sample.
  bool decides = true;

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

/// A lower bound on the number of pixels with a depth that a model's storage cannot hold, whatever
/// was drawn. A coarse storage allows every surface a wide interval, but only few depths in it.
///
/// Exact    a depth is foreign if no code lies within the error that decoding and rounding to
///          binary32 may cause. If this error is more than a quarter of a code, codes are counted:
///          n codes decode to at most n depths, so any further depths in their range are foreign. 0
///          for models of rays, for reversed and written window depths, and for depths that were
///          recorded in another way; binary32 counts for window depths of at least 1/2.
std::uint64_t foreign_values(const Camera& camera, const OtherMap& other,
                             const RendererModel& model);

}  // namespace fathom::attribution
