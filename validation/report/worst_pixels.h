#pragma once

#include <cstddef>
#include <vector>

#include "validation/report/validation_case.h"

namespace fathom::validation {

/// The pixels to look at first, at most `count`: unexplained ones, then those of a convention, then
/// missed ones, then those with the greatest relative errors of depth. Equal ones are left out.
std::vector<std::size_t> worst_pixels(const ValidationCase& validated, std::size_t count);

}  // namespace fathom::validation
