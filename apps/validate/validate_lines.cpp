#include "apps/validate/validate_lines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "fathom/attribution/worst_pixels.h"
#include "validation/report/cause.h"
#include "validation/report/ctest_lines.h"
#include "validation/report/pictures.h"
#include "validation/report/reported_result.h"
#include "validation/report/z_fighting.h"

namespace fathom::app {
namespace {

using attribution::Attribution;
using attribution::PixelClass;
using validation::ValidationCase;

/// A finding, in full or, where the verdict has said it, by its kind.
std::string line_of(const attribution::Finding& f, bool is_said) {
  std::string text =
      is_said ? "  found: " + f.kind + "\n" : "  " + attribution::finding_line(f) + "\n";
  if (!f.alternatives.empty()) {
    text += fmt::format("    as good an explanation: {}\n", fmt::join(f.alternatives, ", "));
  }
  return text;
}

/// "spot, vtk unorm24: 70000 equal, 20 edge; median bound 3.1e-07 of the depth, 1.20 % of the pixels
/// undecided". `after_verdict`: its first finding has been said.
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
  std::string text =
      fmt::format("{}: {}; median bound {:.2g} of the depth, {:.2f} % of the pixels undecided\n",
                  title_of(c), counts, a.median_relative_width, 100 * a.may_share);
  for (const attribution::Finding& f : a.findings) {
    text += line_of(f, after_verdict && &f == &a.findings.front());
  }
  for (const attribution::Finding& f : a.notes) {
    text += "  note: " + attribution::finding_text(f) + "\n";
    for (const std::string& line : f.evidence) text += "    " + line + "\n";
  }
  return text;
}

}  // namespace

std::string lines_of(const std::vector<ValidationCase>& cases) {
  std::string text = validation::verdict_of(cases) + "\n";
  for (const ValidationCase& c : cases) text += line_of(c, cases.size() == 1);
  return text;
}

std::string lines_for_ctest(const ValidationCase& c, const std::string& cause,
                            const std::string& more, const std::string& folder) {
  const std::filesystem::path out(folder);
  std::string text;
  text += (cause.empty() ? validation::verdict_of(c) : cause) + "\n";
  text += line_of(c, !c.is_good()) + more;
  if (!cause.empty()) {
    constexpr std::size_t listed_pixels = 8;
    for (const std::size_t i :
         attribution::worst_pixels(*c.truth, c.other, c.attribution, listed_pixels)) {
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

}  // namespace fathom::app
