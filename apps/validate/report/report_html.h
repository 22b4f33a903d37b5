#pragma once

#include <string>
#include <vector>

#include "apps/validate/report/validation_case.h"

namespace fathom::validation {

/// report.html: a page that needs no other file. It holds report.json and, compressed, every map:
/// depths of the truth and of the others, classes, triangle numbers.
std::string to_html(const std::vector<ValidationCase>& cases);

}  // namespace fathom::validation
