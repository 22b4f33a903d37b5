#pragma once

#include <string>
#include <vector>

#include "validation/report/validation_case.h"

namespace fathom::app {

/// A line for each result, with what was found in lines below it.
std::string lines_of(const std::vector<validation::ValidationCase>& cases);

/// A result as the output of a test. `cause` is why the test fails and comes first; empty where it
/// passes. Then lines_of() it and `more`, the pixels to look at first, where the page lies in
/// `folder`, and lines that CTest reads.
std::string lines_for_ctest(const validation::ValidationCase& validated, const std::string& cause,
                            const std::string& more, const std::string& folder);

}  // namespace fathom::app
