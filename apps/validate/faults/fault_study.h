#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/validate/faults/fault.h"
#include "apps/validate/faults/golden_image.h"
#include "fathom/attribution/attribution.h"
#include "validation/drawn_map.h"

/// How large a fault has to be to be found and rightly named.
namespace fathom::validation {

/// A right map with what is needed to measure and to judge what becomes of it.
struct FaultSubject {
  const ValidationScene& scene;
  attribution::Truth truth;
  attribution::OtherMap map;
  attribution::RendererModel model;
  attribution::Attribution found;  ///< of the right map
};

/// What a renderer without any rounding would draw.
attribution::OtherMap exact_map_of(const ValidationScene& scene);

/// What a renderer drew as a map that someone brings: its depths alone, in binary32.
attribution::OtherMap as_brought(const attribution::OtherMap& drawn);

/// `model`: the named one that fits the renderer.
FaultSubject fault_subject(const ValidationScene& scene, const attribution::OtherMap& drawn,
                           const attribution::RendererModel& model);

/// Median of how far depths of surfaces are changed, in half widths of what the model allows, over
/// the pixels that are changed; infinite where half of these are surfaces that came or went.
double effect_of(const FaultSubject& subject, const attribution::OtherMap& map);

/// Sizes of a fault whose effects are about 1, 3, 10 and 100: with the exact map of what is drawn
/// in place of the renderer's. One of no size has the size 0.
std::vector<double> sizes_of(const Fault& fault, const FaultSubject& subject);

/// A map that went wrong.
attribution::OtherMap changed_map(const Fault& fault, const FaultSubject& subject, double size);

/// What a fault of a size led to.
struct FaultResult {
  double size = 0, effect = 0;
  bool is_found = false;  ///< a pixel is unexplained, something is wrong, or a note tells
  bool is_named = false;  ///< and what is said first is right
  std::string said;       ///< kind and text
  GoldenVerdicts golden;  ///< what comparing pictures says
};

FaultResult judged(const Fault& fault, const FaultSubject& subject,
                   const attribution::OtherMap& map, double size);

}  // namespace fathom::validation
