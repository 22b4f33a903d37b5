#pragma once

#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/other_map.h"
#include "fathom/attribution/truth.h"

namespace fathom::attribution {

/// Faults of single triangles: missing triangles, all back faces missing, ties between equal
/// triangles. A triangle is missing if its absence explains at least three touching pixels and it
/// is visible nowhere; one or two pixels may be chance. `found`: result of attribute().
std::vector<Finding> triangles_at_fault(const Truth& truth, const OtherMap& other,
                                        const Attribution& found);

}  // namespace fathom::attribution
