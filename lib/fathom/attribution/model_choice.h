#pragma once

#include <string>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// What a model makes of a map.
struct ModelTrial {
  RendererModel model;
  Attribution attribution;
};

/// The model that fits a map, what it says of it, and why it was chosen.
struct ModelChoice {
  ModelTrial chosen;
  /// A line for each model that was tried: what it makes of the map, or of a sample of its rows.
  std::vector<std::string> evidence;
};

/// Of the named models that mean something for the camera (near and far, where one is needed): the
/// one with the narrowest bounds that explains every pixel and finds nothing wrong. VTK's are tried
/// only where none of the others does. Where none does, something is wrong with the map: it is
/// looked for by the model that leaves the fewest pixels of a sample open, put right, and told by
/// the narrowest model that then explains the map.
/// Exact    a sample of rows only excludes models, those that leave a pixel of it open: what is
///          chosen has been asked of every pixel. The narrowest is that of the sample.
/// Needs    a map whose background is known.
ModelChoice chosen_model(const Truth& truth, const OtherMap& other);

/// What the named model makes of a map, or, where it leaves pixels open, another: one that explains
/// every pixel, or nine tenths of those that are left when the fault is named that was found. Then
/// a finding of kind `model` says so. A fault of the depths that the named model explains all by
/// comes before a model whose bounds are more than twice as wide, isolated pixels before one with
/// ten times as wide bounds.
/// Needs    a map whose background is known.
ModelTrial judged_by(const Truth& truth, const OtherMap& other, const RendererModel& named);

}  // namespace fathom::attribution
