#pragma once

#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// What is wrong with single triangles: those that are missing, all that are turned away, ties of
/// equal ones. A triangle is missing where its absence explains three pixels or more that touch and
/// it is seen nowhere; what a pixel or two show may be chance.
/// `found`: what attribute() says.
std::vector<Finding> triangles_at_fault(const Truth& truth, const OtherMap& other,
                                        const Attribution& found);

}  // namespace fathom::attribution
