#pragma once

#include <string>

#include "fathom/attribution/cause.h"
#include "validation/report/validation_case.h"

namespace fathom::validation {

/// Why a result is not good, in one line: why there is no map, else the first finding, else how many
/// pixels are unexplained and the one to look at first. Empty where the result is good.
std::string cause_of(const ValidationCase& validated);

/// As attribution::pixel_text().
std::string pixel_text(const ValidationCase& validated, std::size_t pixel);

}  // namespace fathom::validation
