#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "validation/report/validation_case.h"

namespace fathom::validation {

/// What got worse since an earlier report.json: lines for each case that has more unexplained or
/// missed pixels or fewer equal ones, that has a new finding, or that was drawn then and is not now.
/// Improvements are not regressions.
/// Fails    InputError if the file is not such a report.
std::vector<std::string> regressions(const std::vector<ValidationCase>& cases,
                                     const std::filesystem::path& baseline);

}  // namespace fathom::validation
