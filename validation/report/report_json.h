#pragma once

#include <string>
#include <vector>

#include "validation/report/validation_case.h"

namespace fathom::validation {

/// report.json, as docs/validation.md explains it: {"fathom": version, "results": [ … ]}, a result
/// a case. Ends with a newline.
std::string to_json(const std::vector<ValidationCase>& cases);

}  // namespace fathom::validation
