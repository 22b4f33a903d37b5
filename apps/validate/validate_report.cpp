#include "apps/validate/validate_report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "apps/shell/exit_status.h"
#include "apps/shell/folder.h"
#include "apps/shell/known_files.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "fathom/numeric/errors.h"
#include "validation/report/baseline.h"
#include "validation/report/report_html.h"
#include "validation/report/report_json.h"

namespace fathom::app {
namespace {

using attribution::Attribution;
using attribution::PixelClass;
using validation::ValidationCase;

std::string title_of(const ValidationCase& c) {
  return fmt::format("{}, {}{}", c.scene, c.renderer, c.variant.empty() ? "" : " " + c.variant);
}

/// "spot, vtk unorm24: 76800 pixels: 70000 equal, 20 edge; bounds 3.1e-07 wide, 0.012 may".
std::string line_of(const ValidationCase& c) {
  if (!c.is_done()) return fmt::format("{}: {}\n", title_of(c), c.failure);
  const Attribution& a = c.attribution;
  std::string counts;
  for (std::size_t k = 0; k < attribution::pixel_class_count; ++k) {
    if (a.counts[k] == 0) continue;
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", a.counts[k],
                          name_of(static_cast<PixelClass>(k)));
  }
  std::string text = fmt::format("{}: {}; median bound {:.2g} of the depth, {:.2g} may\n",
                                 title_of(c), counts, a.median_relative_width, a.may_share);
  for (const attribution::Finding& f : a.findings) {
    text += fmt::format("  {}: {} ({} pixels)\n", f.kind, f.text, f.pixels);
  }
  return text;
}

}  // namespace

void prepare(const ReportPlaces& places) {
  expect_standard_output();
  if (!places.baseline.empty()) {
    note_input(places.baseline);
    validation::regressions({}, places.baseline);
  }
  if (places.out.empty()) return;
  make_folder(places.out);
  if (::access(places.out.c_str(), W_OK) != 0) {
    throw OutputError(fmt::format("{}: cannot write here: {}", places.out, std::strerror(errno)));
  }
}

int report_cases(const std::vector<ValidationCase>& cases, const ReportPlaces& places) {
  std::vector<std::string> worse;
  if (!places.baseline.empty()) {
    worse = validation::regressions(cases, places.baseline);
  }
  std::string text;
  for (const ValidationCase& c : cases) text += line_of(c);
  for (const std::string& line : worse) text += "worse than the baseline: " + line + "\n";
  print(text);
  if (!places.out.empty()) {
    OutputFile json(std::filesystem::path(places.out) / "report.json");
    OutputFile html(std::filesystem::path(places.out) / "report.html");
    json.write(validation::to_json(cases));
    html.write(validation::to_html(cases));
    OutputFile::commit_together({&json, &html});
  }
  const bool all_good = std::all_of(cases.begin(), cases.end(), [](const ValidationCase& c) {
    return !c.is_done() || c.is_good();
  });
  if (!all_good || !worse.empty()) return answer_is_no;
  const bool all_done =
      std::all_of(cases.begin(), cases.end(), [](const ValidationCase& c) { return c.is_done(); });
  return all_done ? done : unusable_input;
}

}  // namespace fathom::app
