#pragma once

#include <string>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/model/renderer_model.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// Verdict of a model on a map.
struct ModelTrial {
  RendererModel model;
  Attribution attribution;
};

/// The model that fits a map, its verdict, and the reason for the choice.
struct ModelChoice {
  ModelTrial chosen;
  /// A line for each tried model: its verdict on the map, or on a sample of its rows.
  std::vector<std::string> evidence;
};

/// Among the named models that apply to the camera (near and far, if needed): the model with the
/// narrowest bounds that explains every pixel without a finding. VTK's models are tried last. If no
/// model explains the map, the map has a fault. The model that leaves the fewest pixels of a sample
/// open searches for it, and the narrowest model that explains the corrected map names it. Models
/// that allow nearly any depth (Sharpness::decides) explain only a map for which this fails, and
/// the finding is `undecided`.
/// Exact    a sample of rows only excludes models, which leave a pixel of it open. The chosen model
///          has judged every pixel. Widths of bounds are compared on the sample.
/// Needs    a map whose background is known.
ModelChoice chosen_model(const Truth& truth, const OtherMap& other);

/// Verdict of the named model on a map. If it leaves pixels open, verdict of another model that
/// explains every pixel, or nine tenths of the pixels that remain after the found fault; a finding
/// of kind `model` then names it. A fault of the depths with which the named model explains
/// everything precedes a model whose bounds are more than twice as wide, and isolated pixels
/// precede a model whose bounds are more than ten times as wide; if the bounds are that wide, VTK's
/// models are tried too. Models that allow nearly any depth:
/// - A named one that explains every pixel yields to another model that explains every pixel, with
///   a note. Otherwise it gets the note `undecided`, and no finding.
/// - Another one becomes a finding of kind `model` if neither a narrower model nor a fault explains
///   every pixel.
/// Needs    a map whose background is known.
ModelTrial judged_by(const Truth& truth, const OtherMap& other, const RendererModel& named);

}  // namespace fathom::attribution
