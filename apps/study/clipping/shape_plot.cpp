#include "apps/study/clipping/shape_plot.h"

#include <fmt/format.h>

#include "apps/study/gnuplot.h"

namespace fathom::studies {
namespace {

/// A data block of gnuplot: closed rings, an empty line after each.
std::string data_block(const char* name, const std::vector<Outline>& rings) {
  std::string text = fmt::format("{} << EOD\n", name);
  for (const Outline& ring : rings) {
    for (std::size_t i = 0; i <= ring.size(); ++i) {
      const auto& [x, y] = ring[i % ring.size()];
      text += fmt::format("{} {}\n", x, y);
    }
    text += "\n";
  }
  return text + "EOD\n";
}

std::string panel(const char* data, const std::string& title) {
  return fmt::format(
      "set title '{1}'\n"
      "plot $subject with lines lc rgb '#aaaaaa' lw 1, $window with lines lc rgb '#888888' dt 2, "
      "{0} with filledcurves closed fc rgb '#9ecae1' notitle, "
      "{0} with lines lc rgb '#b2182b' lw 3\n",
      data, title);
}

}  // namespace

std::vector<StudyFile> draw(const ClippedShape& shape) {
  return run_gnuplot(
      "shape-" + shape.name,
      data_block("$subject", {shape.subject}) + data_block("$window", {shape.window}) +
          data_block("$a", shape.reentrant) + data_block("$b", shape.pieces) +
          data_block("$c", shape.decomposed) +
          "set multiplot layout 1,3\nset size ratio -1\nset offsets 0.5, 0.5, 0.5, 0.5\n"
          "unset key\nunset border\nunset tics\n" +
          panel("$a", "Sutherland-Hodgman: one ring") +
          panel("$b", fmt::format("Weiler-Atherton: {} pieces", shape.pieces.size())) +
          panel("$c", fmt::format("convex pieces first: {}", shape.decomposed.size())) +
          "unset multiplot\n",
      400);
}

}  // namespace fathom::studies
