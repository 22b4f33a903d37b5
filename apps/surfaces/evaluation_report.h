#pragma once

#include <string>
#include <vector>

#include "fathom/evaluate.h"

namespace fathom::app {

/// `within` are the thresholds.
std::string as_text(const Evaluation& evaluation, const std::vector<double>& within);
std::string as_json(const Evaluation& evaluation, const std::vector<double>& within);

}  // namespace fathom::app
