#pragma once

#include <string>
#include <vector>

#include "apps/validate/report/validation_case.h"
#include "fathom/attribution/cause.h"

namespace fathom::validation {

/// Why a result is not good, in one line: why there is no map, else the first finding, else how
/// many pixels are unexplained and the one to look at first. Empty where the result is good.
std::string cause_of(const ValidationCase& validated);

/// What is to be said first of a result: as attribution::verdict_text(), or why there is no map.
std::string verdict_of(const ValidationCase& validated);

/// The same of several: how many failed, and the first of them.
std::string verdict_of(const std::vector<ValidationCase>& cases);

/// As attribution::pixel_text().
std::string pixel_text(const ValidationCase& validated, std::size_t pixel);

}  // namespace fathom::validation
