#pragma once

#include <string>
#include <vector>

#include "apps/validate/report/validation_case.h"

namespace fathom::validation {

/// report.json, explained in docs/validation.md: {"fathom": version, "format": report_format,
/// "verdict": verdict_of(cases), "results": [ … ]}, one result for each case. Ends with a newline.
std::string to_json(const std::vector<ValidationCase>& cases);

}  // namespace fathom::validation
