#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/validate/report/validation_case.h"
#include "fathom/attribution/attribution.h"

/// The results in a report.json, without maps and pixels: all data by which two runs are compared.
namespace fathom::validation {

/// The layout of report.json that is written, and the only layout that is read. A report without a
/// number has this layout. The number grows if something that is read changes its name or meaning.
inline constexpr int report_format = 1;

/// One renderer in one of its variants on one scene. Without a map (`failure`), all that follows
/// `failure` is empty.
struct ReportedResult {
  std::string scene, renderer, variant, version, failure;
  /// Pixels of the image; triangles of the scene.
  std::uint32_t width = 0, height = 0;
  std::uint64_t triangles = 0;
  std::array<std::uint64_t, attribution::pixel_class_count> counts{};
  /// Errors of depth relative to the exact depth, and the width of the bound likewise; NaN without
  /// a bound.
  double median_error = 0, greatest_error = 0, median_bound = 0;
  std::vector<attribution::Finding> findings;

  [[nodiscard]] bool is_done() const { return failure.empty(); }
};

struct Report {
  /// The version of Fathom that wrote it.
  std::string fathom;
  std::vector<ReportedResult> results;
};

/// "spot, vtk unorm24", as lines on the terminal name a result.
std::string title_of(const std::string& scene, const std::string& renderer,
                     const std::string& variant);
inline std::string title_of(const ReportedResult& r) {
  return title_of(r.scene, r.renderer, r.variant);
}
inline std::string title_of(const ValidationCase& c) {
  return title_of(c.scene, c.renderer, c.variant);
}

/// The results of this run.
Report reported(const std::vector<ValidationCase>& cases);

/// The report.json of an earlier run.
/// Fails    InputError if the file is not a report, is truncated, or has another layout: one line
///          with a remedy.
Report read_report(const std::filesystem::path& file);

}  // namespace fathom::validation
