#pragma once

#include <optional>

#include "fathom/attribution/attribution.h"

namespace fathom::attribution {

/// A formula by which the other's depths follow from the exact ones at nearly all pixels where both
/// show a surface: `scale` or `decoding`, its constants estimated. The first of those that are
/// tried.
std::optional<Finding> related_depths(const Truth& truth, const OtherMap& other);

}  // namespace fathom::attribution
