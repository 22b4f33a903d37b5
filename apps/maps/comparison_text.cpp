#include <fmt/core.h>

#include "apps/maps/comparison_report.h"
#include "apps/shell/values.h"
#include "fathom/text/counted.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

std::string to_text(const std::optional<PixelPosition>& pixel, const char* what) {
  return pixel ? fmt::format(" ({} at {},{})", what, pixel->x, pixel->y) : "";
}

std::string figures_line(const char* name, const DifferenceSummary& s) {
  return fmt::format("  {:<9} {:>13.6g} {:>13.6g} {:>13.6g} {:>13.6g} {:>13.6g} {:>13.6g}\n", name,
                     s.max, s.mean, s.p50, s.p90, s.p99, s.p99_9);
}

std::string greatest_line(const DifferenceSummary& s, const char* unit) {
  if (s.max == 0) return "";
  return fmt::format("  greatest  {}{} at {},{}\n", s.max, unit, s.worst.x, s.worst.y);
}

std::string pixels_line(std::uint64_t pixels, std::uint64_t left_out) {
  return fmt::format("  metrics   over {}{}\n", text::counted(pixels, "pixel"),
                     left_out == 0 ? "" : fmt::format(", {} left out", left_out));
}

std::string to_text(const DepthMetrics& m) {
  return pixels_line(m.pixels, m.left_out) +
         fmt::format("    AbsRel {:.6g}, SqRel {:.6g}, RMSE {:.6g}, RMSE log {:.6g}, MAE {:.6g}\n",
                     m.abs_rel, m.sq_rel, m.rmse, m.rmse_log, m.mae) +
         fmt::format("    below 1.25: {:.6g} %, 1.25^2: {:.6g} %, 1.25^3: {:.6g} %\n",
                     100 * m.delta_1, 100 * m.delta_2, 100 * m.delta_3);
}

std::string to_text(const DisparityMetrics& m) {
  return pixels_line(m.pixels, m.left_out) +
         fmt::format("    EPE {:.6g}, RMSE {:.6g}\n", m.epe, m.rmse) +
         fmt::format("    off by more than 0.5: {:.6g} %, 1: {:.6g} %, 2: {:.6g} %\n",
                     100 * m.bad_0_5, 100 * m.bad_1, 100 * m.bad_2);
}

/// "2 ulp, 0.001 absolute or 1e-06 relative", those that are not 0.
std::string to_text(const CompareOptions& options) {
  std::vector<std::string> tolerances;
  if (options.tolerance_ulp > 0 ||
      (options.tolerance_absolute == 0 && options.tolerance_relative == 0))
    tolerances.push_back(fmt::format("{} ulp", options.tolerance_ulp));
  if (options.tolerance_absolute > 0)
    tolerances.push_back(fmt::format("{} absolute", options.tolerance_absolute));
  if (options.tolerance_relative > 0)
    tolerances.push_back(fmt::format("{} relative", options.tolerance_relative));
  return joined(tolerances, " or ");
}

std::string to_text(const ChannelComparison& c) {
  std::string text = c.truth_channel == c.other_channel
                         ? fmt::format("channel {}\n", text::printable(c.truth_channel))
                         : fmt::format("channel {} against {}\n", text::printable(c.truth_channel),
                                       text::printable(c.other_channel));
  text += fmt::format(
      "  surface   in both {}, in neither {}, in the first only {}, in the other only {}{}\n",
      c.both, c.neither, c.only_truth, c.only_other,
      to_text(c.first_coverage_disagreement, "first"));
  text += fmt::format("  bit-equal {} of {}\n", c.bit_equal, c.both);
  if (c.identifiers) {
    text += fmt::format("  different {}{}\n", c.different_identifiers,
                        to_text(c.first_mismatch, "first"));
  } else {
    text += fmt::format("  {:<9} {:>13} {:>13} {:>13} {:>13} {:>13} {:>13}\n", "", "maximum",
                        "mean", "50 %", "90 %", "99 %", "99.9 %");
    text += figures_line("absolute", c.absolute) + figures_line("relative", c.relative);
    if (c.is_around_zero) {
      text += greatest_line(c.absolute, "");
    } else {
      text += figures_line("ulp", c.ulp) + greatest_line(c.ulp, " ulp");
    }
    if (c.incommensurable > 0) {
      text += fmt::format("  infinite or NaN in one only: {}{}\n", c.incommensurable,
                          to_text(c.first_mismatch, "first"));
    }
  }
  if (c.depth_metrics) text += to_text(*c.depth_metrics);
  if (c.disparity_metrics) text += to_text(*c.disparity_metrics);
  for (const std::string& note : c.notes) text += "  note: " + text::printable(note) + "\n";
  return text;
}

}  // namespace

std::string as_text(const Comparison& comparison) {
  const MapComparison& maps = comparison.maps;
  std::string text;
  for (const ChannelComparison& channel : maps.channels) text += to_text(channel);
  if (!maps.only_in_truth.empty()) {
    text +=
        fmt::format("only in the first: {}\n", text::printable(joined(maps.only_in_truth, ", ")));
  }
  if (!maps.only_in_other.empty()) {
    text +=
        fmt::format("only in the other: {}\n", text::printable(joined(maps.only_in_other, ", ")));
  }
  for (const std::string& note : maps.notes) text += "note: " + text::printable(note) + "\n";
  return text + fmt::format("the maps {} within {}\n",
                            maps.within_tolerance() ? "agree" : "do not agree",
                            to_text(comparison.options));
}

}  // namespace fathom::app
