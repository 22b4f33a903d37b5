#pragma once

#include <filesystem>
#include <string>

#include "apps/validate/report/validation_case.h"

namespace fathom::validation {

/// Pictures of a result, where they lie.
struct PictureFiles {
  std::filesystem::path classes, differences;
};

/// What CTest reads from the output of a test and passes on to CDash: the cause of its failure, if
/// there is one, as its details; the pixels of each class, the bound and the greatest error as
/// measurements; the pictures as files.
/// Needs    a map.
/// Source   ctest(1), "Additional Test Measurements".
std::string to_ctest_lines(const ValidationCase& validated, const std::string& cause,
                           const PictureFiles& pictures);

}  // namespace fathom::validation
