#pragma once

#include <string>

#include "apps/validate/report/comparison.h"

namespace fathom::validation {

/// comparison.html: a page that needs no other file, with what changed between two runs, and links
/// report.html beside it.
std::string to_html(const Comparison& comparison);

}  // namespace fathom::validation
