#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/shell/console.h"
#include "apps/shell/output_file.h"
#include "apps/validate/report/comparison.h"
#include "apps/validate/report/validation_case.h"
#include "apps/validate/validate_arguments.h"

namespace fathom::app {

/// Makes the folder of a report, if requested; call it before the work, like the constructor
/// below.
/// Fails    OutputError if standard output or the folder cannot be written.
void prepare_answer(const std::string& out);

/// "results" of a validation as JSON, in a file of the requested folder. Constructed before the
/// work, so that an unwritable file is reported at once.
class ResultsFile {
 public:
  /// No folder: nothing is written.
  /// Fails    OutputError
  ResultsFile(const std::string& out, const char* name);

  /// Puts the file in its place. `results` is an array.
  void write(const nlohmann::ordered_json& results);

 private:
  std::optional<OutputFile> file_;
};

/// Answer of a validation: lines on standard output, and the requested files. Constructed before
/// the work, so that unwritable files and an unreadable baseline are reported at once.
class ValidationReport {
 public:
  /// Takes --output, --junit, --baseline and --ctest.
  /// Fails    OutputError, InputError; UsageError where --ctest has no --output.
  explicit ValidationReport(const ValidateArguments& arguments);

  /// Prints the verdict, a line for each case and its findings (with --junit - the JUnit XML
  /// instead), puts the files in their places, all or none, and returns the exit status:
  /// answer_is_no where a result is wrong or, if the baseline has it, worse than there;
  /// unusable_input where a renderer did not draw or the baseline is of other scenes. On a terminal
  /// `console` names the page.
  [[nodiscard]] int finish(const std::vector<validation::ValidationCase>& cases,
                           const Console& console);

 private:
  struct Folder {
    OutputFile json, html;
    std::optional<OutputFile> comparison, classes, differences;
  };

  [[nodiscard]] std::string obstacle_of(const validation::Comparison& comparison) const;
  void write_files(const std::vector<validation::ValidationCase>& cases,
                   const validation::Comparison* comparison);
  void commit();

  std::string out_, baseline_name_;
  bool for_ctest_, junit_is_the_answer_;
  std::optional<validation::Report> baseline_;
  TextOutput junit_;
  std::optional<Folder> folder_;
};

}  // namespace fathom::app
