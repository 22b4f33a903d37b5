#pragma once

#include <cstddef>
#include <vector>

#include "fathom/attribution/attribution.h"

namespace fathom::attribution {

/// The pixels to look at first, at most `count`: unexplained ones, then those of a convention, then
/// missed ones, then those with the greatest relative errors of depth. Equal ones are left out.
std::vector<std::size_t> worst_pixels(const Truth& truth, const OtherMap& other,
                                      const Attribution& found, std::size_t count);

}  // namespace fathom::attribution
