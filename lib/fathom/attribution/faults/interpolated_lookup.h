#pragma once

#include <optional>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/faults/local_faults.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// `remapped`: the map of a pinhole was looked up bilinearly at the places where the lens's rays
/// lie in it. A depth is then a mean of four depths of the pinhole's map, between surfaces too.
///
/// A pixel is explained if its value is such a mean: of depths that the model allows for the
/// pinhole's pixels, at a place that is known up to roundings of binary32, with weights as they are
/// or, as in OpenCV, in 32nds of a pixel. Returns nullopt if the pixels of the image with
/// other values are more than a tenth of the unexplained pixels.
///
/// Bounds   docs/validation.md, "Maps that are looked up".
/// Needs    `found`, the result of attribute() for the truth, which has a lens.
std::optional<PixelFinding> interpolated_lookup(const Truth& truth, const OtherMap& other,
                                                const RendererModel& model,
                                                const Attribution& found);

}  // namespace fathom::attribution
