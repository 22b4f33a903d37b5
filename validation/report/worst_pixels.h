#pragma once

#include <cstddef>
#include <vector>

#include "validation/report/validation_case.h"

namespace fathom::validation {

/// Pixels to look at first, at most `count`: unexplained ones, then those of a convention, missed
/// ones, and those whose depth is farthest off, relatively. None where the other is exact.
std::vector<std::size_t> worst_pixels(const ValidationCase& validated, std::size_t count);

}  // namespace fathom::validation
