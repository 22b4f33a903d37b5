#pragma once

#include <string>
#include <vector>

#include "validation/report/validation_case.h"

namespace fathom::app {

struct ReportPlaces {
  /// Folder for report.json and report.html; empty: none is written.
  std::string out;
  /// An earlier report.json to compare with; empty: none.
  std::string baseline;
};

/// To be called before the work: it need not be done where the report cannot be written or the
/// baseline not be read. Fails with OutputError, InputError.
void prepare(const ReportPlaces& places);

/// Prints a line for each case and what was found, writes the report, and returns the exit status:
/// answer_is_no where something is unexplained, wrong or worse than in the baseline, unusable_input
/// where a renderer did not draw.
int report_cases(const std::vector<validation::ValidationCase>& cases, const ReportPlaces& places);

}  // namespace fathom::app
