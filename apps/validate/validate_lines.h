#pragma once

#include <string>
#include <vector>

#include "validation/report/validation_case.h"

namespace fathom::app {

/// The verdict, then a line for each result, with its findings in lines below it.
std::string lines_of(const std::vector<validation::ValidationCase>& cases);

/// A result as the output of a test. `cause` is why the test fails and comes first; empty where it
/// passes, then the verdict does. Then the result's lines and `more`, the pixels to look at first, where the page lies in
/// `folder`, and lines that CTest reads.
std::string lines_for_ctest(const validation::ValidationCase& validated, const std::string& cause,
                            const std::string& more, const std::string& folder);

}  // namespace fathom::app
