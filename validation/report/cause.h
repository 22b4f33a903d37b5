#pragma once

#include <string>

#include "validation/report/validation_case.h"

namespace fathom::validation {

/// Why a result is not good, in one line: why there is no map, else the first finding, else how many
/// pixels are unexplained and the one to look at first. Empty where the result is good.
std::string cause_of(const ValidationCase& validated);

/// A pixel with its depths: "(12, 7): 3.25 instead of 3.21, allowed 3.2099 to 3.2101". Depths are in
/// scene units, to 9 digits.
std::string pixel_text(const ValidationCase& validated, std::size_t pixel);

}  // namespace fathom::validation
