#include "apps/validate/validate_report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "apps/shell/output_place.h"
#include "apps/shell/standard_streams.h"
#include "apps/validate/validate_lines.h"
#include "fathom/failures/errors.h"
#include "fathom/image/rgb_image.h"
#include "validation/report/cause.h"
#include "validation/report/comparison_html.h"
#include "validation/report/junit.h"
#include "validation/report/pictures.h"
#include "validation/report/read_report.h"
#include "validation/report/report_html.h"
#include "validation/report/report_json.h"

namespace fathom::app {
namespace {

using validation::Comparison;
using validation::ValidationCase;
using validation::Verdict;

validation::Report read_baseline(const std::string& file) {
  note_input(file);
  return validation::read_report(file);
}

void write_picture(const std::optional<OutputFile>& file, const RgbImage& picture) {
  if (!file) return;
  file->write([&](const std::filesystem::path& path) { write_png(picture, path); });
}

int status_of(const std::vector<ValidationCase>& cases, const Comparison* comparison) {
  const auto is_wrong = [](const ValidationCase& c) { return c.is_done() && !c.is_good(); };
  if (std::any_of(cases.begin(), cases.end(), is_wrong)) return answer_is_no;
  if (comparison != nullptr && comparison->count(Verdict::worse) > 0) return answer_is_no;
  const auto is_done = [](const ValidationCase& c) { return c.is_done(); };
  if (!std::all_of(cases.begin(), cases.end(), is_done)) return unusable_input;
  return comparison == nullptr || comparison->obstacle().empty() ? done : unusable_input;
}

}  // namespace

void prepare_answer(const std::string& out) {
  expect_standard_output();
  if (out.empty()) return;
  make_folder(out);
  if (::access(out.c_str(), W_OK) != 0) {
    throw OutputError(fmt::format("{}: cannot write here: {}", out, std::strerror(errno)));
  }
}

ValidationReport::ValidationReport(const ValidateArguments& arguments)
    : out_(arguments.output),
      baseline_name_(arguments.baseline),
      for_ctest_(arguments.for_ctest),
      junit_is_the_answer_(arguments.junit == "-"),
      junit_(arguments.junit) {
  if (for_ctest_ && out_.empty()) {
    throw UsageError("--ctest needs -o DIR, where the pictures go");
  }
  if (!arguments.baseline.empty()) baseline_ = read_baseline(arguments.baseline);
  prepare_answer(out_);
  if (out_.empty()) return;
  const std::filesystem::path out(out_);
  folder_.emplace(Folder{.json = OutputFile(out / "report.json"),
                         .html = OutputFile(out / "report.html"),
                         .comparison = {},
                         .classes = {},
                         .differences = {}});
  if (baseline_) folder_->comparison.emplace(out / "comparison.html");
  if (!for_ctest_) return;
  folder_->classes.emplace(out / validation::class_picture_name);
  folder_->differences.emplace(out / validation::difference_picture_name);
}

std::string ValidationReport::obstacle_of(const Comparison& comparison) const {
  const std::string obstacle = comparison.obstacle();
  if (obstacle.empty()) return "";
  return fmt::format("{}: {}: expected a report of the same scenes and size, written with --output",
                     baseline_name_, obstacle);
}

int ValidationReport::finish(const std::vector<ValidationCase>& cases) {
  std::optional<Comparison> compared;
  if (baseline_) compared = validation::compare(*baseline_, validation::reported(cases));
  const Comparison* comparison = compared ? &*compared : nullptr;
  std::string changes, obstacle;
  if (comparison != nullptr) {
    changes = validation::lines_of(*comparison);
    obstacle = obstacle_of(*comparison);
    if (!obstacle.empty()) changes += obstacle + "\n";
  }
  std::string cause =
      for_ctest_ && !cases.front().is_good() ? validation::verdict_of(cases.front()) : "";
  if (cause.empty() && comparison != nullptr) cause = comparison->regression();
  if (cause.empty()) cause = obstacle;
  write_files(cases, comparison);
  // Answers on standard output go out before files take their places.
  if (junit_is_the_answer_) {
    junit_.print();
  } else {
    print(for_ctest_ ? lines_for_ctest(cases.front(), cause, changes, out_)
                     : lines_of(cases) + changes);
  }
  commit();
  return status_of(cases, comparison);
}

void ValidationReport::write_files(const std::vector<ValidationCase>& cases,
                                   const Comparison* comparison) {
  junit_.write(validation::to_junit(cases, comparison));
  if (!folder_) return;
  folder_->json.write(validation::to_json(cases));
  folder_->html.write(validation::to_html(cases));
  if (comparison != nullptr) folder_->comparison->write(validation::to_html(*comparison));
  if (!for_ctest_) return;
  write_picture(folder_->classes, validation::class_picture(cases.front()));
  write_picture(folder_->differences, validation::difference_picture(cases.front()));
}

void ValidationReport::commit() {
  std::vector<OutputFile*> outputs;
  if (junit_.file() != nullptr) outputs.push_back(junit_.file());
  if (folder_) {
    outputs.insert(outputs.end(), {&folder_->json, &folder_->html});
    for (auto* file : {&folder_->comparison, &folder_->classes, &folder_->differences}) {
      if (*file) outputs.push_back(&**file);
    }
  }
  OutputFile::commit_together(outputs);
}

}  // namespace fathom::app
