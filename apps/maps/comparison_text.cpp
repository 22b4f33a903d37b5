#include <fmt/core.h>

#include "apps/maps/comparison_report.h"
#include "apps/shell/values.h"
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
    text += figures_line("absolute", c.absolute) + figures_line("relative", c.relative) +
            figures_line("ulp", c.ulp);
    if (c.ulp.max > 0) {
      text += fmt::format("  greatest  {} ulp at {},{}\n", c.ulp.max, c.ulp.worst.x, c.ulp.worst.y);
    }
    if (c.incommensurable > 0) {
      text += fmt::format("  infinite or NaN in one only: {}{}\n", c.incommensurable,
                          to_text(c.first_mismatch, "first"));
    }
  }
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
  return text + fmt::format("the maps {} within {} ulp\n",
                            maps.within_tolerance() ? "agree" : "do not agree",
                            comparison.tolerance_ulp);
}

}  // namespace fathom::app
