#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/report/validation_case.h"

namespace fathom::validation {

/// What got worse since an earlier report.json: a line for each case that has more unexplained or
/// missed pixels or fewer equal ones, that found something new, or that was drawn then and not now.
/// What got better is no regression.
/// Fails    InputError where the file is no such report.
std::vector<std::string> regressions(const std::vector<ValidationCase>& cases,
                                     const std::filesystem::path& baseline);

}  // namespace fathom::validation
