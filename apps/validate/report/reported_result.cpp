#include "apps/validate/report/reported_result.h"

#include "fathom/text/version.h"

namespace fathom::validation {

std::string title_of(const std::string& scene, const std::string& renderer,
                     const std::string& variant) {
  return scene + ", " + renderer + (variant.empty() ? "" : " " + variant);
}

Report reported(const std::vector<ValidationCase>& cases) {
  Report report{.fathom = text::version_in_outputs(), .results = {}};
  for (const ValidationCase& c : cases) {
    ReportedResult result{.scene = c.scene,
                          .renderer = c.renderer,
                          .variant = c.variant,
                          .version = c.version,
                          .failure = c.failure};
    if (c.is_done()) {
      result.width = c.other.width;
      result.height = c.other.height;
      result.triangles = c.truth->mesh.triangles.size();
      result.counts = c.attribution.counts;
      result.median_error = c.attribution.errors.median_relative;
      result.greatest_error = c.attribution.errors.greatest_relative;
      result.median_bound = c.attribution.sharpness.median_relative_width;
      result.findings = c.attribution.findings;
    }
    report.results.push_back(std::move(result));
  }
  return report;
}

}  // namespace fathom::validation
