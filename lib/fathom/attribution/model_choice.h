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
  /// A line for each model: its name, the pixels that it leaves unexplained, how wide its bounds
  /// are.
  std::vector<std::string> evidence;
};

/// Of the named models that mean something for the camera (near and far, where one is needed): the
/// one that leaves the fewest pixels unexplained with the fewest faults, of those the one with the
/// narrowest bounds. VTK's are tried only where none of the others explains the map without a fault.
ModelChoice chosen_model(const Truth& truth, const OtherMap& other);

}  // namespace fathom::attribution
