#include "apps/validate/validate_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/shell/failures.h"
#include "apps/shell/folder_argument.h"
#include "apps/shell/known_files.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "apps/validate/report/report_formats.h"
#include "apps/validate/report/reported_result.h"
#include "apps/validate/report/validation_case.h"
#include "fathom/attribution/attribution.h"
#include "fathom/failures/errors.h"
#include "fathom/image/rgb_image.h"

namespace fathom::app {
namespace {

using attribution::Attribution;
using attribution::PixelClass;
using validation::Comparison;
using validation::ValidationCase;
using validation::Verdict;

/// A finding, in full or, where the verdict has said it, by its kind.
std::string line_of(const attribution::Finding& f, bool is_said) {
  std::string text =
      is_said ? "  found: " + f.kind + "\n" : "  " + attribution::finding_line(f) + "\n";
  if (!f.alternatives.empty()) {
    text += fmt::format("    as good an explanation: {}\n", fmt::join(f.alternatives, ", "));
  }
  return text;
}

/// More lines of evidence for a note are only counted.
constexpr std::size_t most_evidence = 3;

/// "spot, vtk unorm24: 70000 equal, 20 edge; median bound 3.1e-07 of the depth, 1.20 % of the
/// pixels undecided". `after_verdict`: its first finding has been said.
std::string line_of(const ValidationCase& c, bool after_verdict) {
  if (!c.is_done()) return fmt::format("{}: {}\n", title_of(c), c.failure);
  const Attribution& a = c.attribution;
  std::string counts;
  for (std::size_t k = 0; k < attribution::pixel_class_count; ++k) {
    const auto pixel_class = static_cast<PixelClass>(k);
    std::string clause;
    if (pixel_class == PixelClass::z_fight) {
      clause = validation::z_fight_clause(c);
    } else if (a.counts[k] != 0) {
      clause = fmt::format("{} {}", a.counts[k], name_of(pixel_class));
    }
    if (!clause.empty()) counts += (counts.empty() ? "" : ", ") + clause;
  }
  std::string text = fmt::format(
      "{}: {}; median bound {:.2g} of the depth, {:.2f} % of the pixels undecided\n", title_of(c),
      counts, a.sharpness.median_relative_width, 100 * a.sharpness.may_share);
  for (const attribution::Finding& f : a.findings) {
    text += line_of(f, after_verdict && &f == &a.findings.front());
  }
  for (const attribution::Finding& f : a.notes) {
    text += "  note: " + attribution::finding_text(f) + "\n";
    const std::size_t shown = std::min(f.evidence.size(), most_evidence);
    for (std::size_t k = 0; k < shown; ++k) text += "    " + f.evidence[k] + "\n";
    if (shown < f.evidence.size()) {
      text +=
          fmt::format("    and {} more; report.json of -o has all\n", f.evidence.size() - shown);
    }
  }
  return text;
}

/// The verdict, then a line for each result, with its findings in lines below it.
std::string lines_of(const std::vector<ValidationCase>& cases) {
  std::string text = validation::verdict_of(cases) + "\n";
  for (const ValidationCase& c : cases) text += line_of(c, cases.size() == 1);
  return text;
}

/// A result as the output of a test. `cause` is why the test fails and comes first; empty where it
/// passes, then the verdict does. Then the result's lines and `more`, the pixels to look at first,
/// where the page lies in `folder`, and lines that CTest reads.
std::string lines_for_ctest(const ValidationCase& c, const std::string& cause,
                            const std::string& more, const std::string& folder) {
  const std::filesystem::path out(folder);
  const std::string verdict = validation::verdict_of(c);
  const bool is_accepted = cause.empty() && !c.is_good();
  std::string text = (is_accepted     ? "no worse than the baseline: " + verdict
                      : cause.empty() ? verdict
                                      : cause) +
                     "\n";
  text += line_of(c, !c.is_good() && (is_accepted || cause == verdict)) + more;
  if (!cause.empty()) {
    for (const std::size_t i :
         attribution::worst_pixels(*c.truth, c.other, c.attribution, validation::listed_pixels)) {
      text +=
          fmt::format("  {} {}\n", name_of(c.attribution.classes[i]), validation::pixel_text(c, i));
    }
    text += std::filesystem::absolute(out / "report.html").string() + "\n";
  }
  return text +
         validation::to_ctest_lines(c, cause,
                                    {.classes = out / validation::class_picture_name,
                                     .differences = out / validation::difference_picture_name});
}

validation::Report read_baseline(const std::string& file) {
  refuse_folder_of("report.json", file);
  note_input(file);
  return validation::read_report(file);
}

void write_picture(const std::optional<OutputFile>& file, const RgbImage& picture) {
  if (!file) return;
  file->write([&](const std::filesystem::path& path) { write_png(picture, path); });
}

/// Whether case number i is wrong. If a baseline has it, only what changed counts.
bool counts_as_wrong(const std::vector<ValidationCase>& cases, std::size_t i,
                     const Comparison* comparison) {
  if (!cases[i].is_done() || cases[i].is_good()) return false;
  // A comparison begins with this run's results, in their order.
  return comparison == nullptr || comparison->changes[i].verdict == Verdict::appeared;
}

int status_of(const std::vector<ValidationCase>& cases, const Comparison* comparison) {
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (counts_as_wrong(cases, i, comparison)) return answer_is_no;
  }
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

ResultsFile::ResultsFile(const std::string& out, const char* name) {
  prepare_answer(out);
  if (!out.empty()) file_.emplace(std::filesystem::path(out) / name);
}

void ResultsFile::write(const nlohmann::ordered_json& results) {
  if (!file_) return;
  file_->write(json_answer({{"results", results}}));
  file_->commit();
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

int ValidationReport::finish(const std::vector<ValidationCase>& cases, const Console& console) {
  std::optional<Comparison> compared;
  if (baseline_) compared = validation::compare(*baseline_, validation::reported(cases));
  const Comparison* comparison = compared ? &*compared : nullptr;
  std::string changes, obstacle;
  if (comparison != nullptr) {
    changes = validation::lines_of(*comparison);
    obstacle = obstacle_of(*comparison);
    if (!obstacle.empty()) changes += obstacle + "\n";
  }
  std::string cause = for_ctest_ && counts_as_wrong(cases, 0, comparison)
                          ? validation::verdict_of(cases.front())
                          : "";
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
  if (folder_ && console.shows_progress()) {
    console.note((std::filesystem::path(out_) / "report.html").string() + " is the page");
  }
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
