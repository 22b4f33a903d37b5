#pragma once

#include <string>
#include <vector>

#include "apps/validate/report/comparison.h"
#include "apps/validate/report/validation_case.h"

namespace fathom::validation {

/// A JUnit XML file, as CI services read it: a test suite for each scene, a test case for each
/// renderer and variant with the pixels of each class as properties, and its time where that was
/// measured. A `failure` is what is unexplained or found (message: verdict_of()) or, with a
/// comparison, worse; an `error` is what was not drawn or cannot be compared.
/// Needs    the comparison, if there is one, to be of the same cases.
std::string to_junit(const std::vector<ValidationCase>& cases, const Comparison* comparison);

}  // namespace fathom::validation
