#include "apps/study/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/study/drawn_files.h"

namespace fathom::studies {
namespace {

/// Text between double quotes in a script, in plain letters: no markup, no escapes.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

/// Colours that are told apart by the colour-blind (Okabe and Ito), darkest first.
constexpr const char* colours[] = {"#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                   "#56B4E9", "#E69F00", "#7F7F7F", "#8B4513"};
constexpr int colour_count = 9;

std::string axes(const std::string& title, const std::string& y_label) {
  return fmt::format(
      "set title {} noenhanced\nset ylabel {} noenhanced\nset key outside right noenhanced\n"
      "set grid\n",
      quoted(title), quoted(y_label));
}

bool is_negative(const Series& series) {
  return std::any_of(series.points.begin(), series.points.end(),
                     [](const auto& point) { return point.second < 0; });
}

Plot drawable(Plot plot) {
  const auto has_place = [&plot](double x, bool logarithmic) {
    return std::isfinite(x) && (x > 0 || !logarithmic || plot.stretched_by_all);
  };
  for (Series& series : plot.series) {
    std::erase_if(series.points, [&](const auto& point) {
      return !has_place(point.first, plot.logarithmic_x) ||
             !has_place(point.second, plot.logarithmic_y);
    });
  }
  std::erase_if(plot.series, [](const Series& series) { return series.points.empty(); });
  return plot;
}

std::string script_of(const Plot& plot) {
  std::string script;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    script += fmt::format("$series{} << END\n", i);
    for (const auto& [x, y] : plot.series[i].points) {
      script += fmt::format("{:.17g} {:.17g}\n", x, y);
    }
    script += "END\n";
  }
  script += axes(plot.title, plot.y_label);
  script += fmt::format("set xlabel {} noenhanced\n", quoted(plot.x_label));
  if (plot.logarithmic_x) script += "set logscale x\nset format x \"10^{%L}\"\n";
  if (plot.logarithmic_y)
    script += "set logscale y\nset format y \"10^{%L}\"\n";
  else if (std::none_of(plot.series.begin(), plot.series.end(), is_negative)) {
    script += "set yrange [0:*]\n";
  }
  script += "plot \\\n";
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const std::size_t marks = 1 + plot.series[i].points.size() / 12;
    script += fmt::format(
        "  $series{} with linespoints title {} lw 1.5 dt {} pt {} ps 0.8 pi {} lc rgb \"{}\"{}\n",
        i, quoted(plot.series[i].label), i % 5 + 1, i % 13 + 1, marks, colours[i % colour_count],
        i + 1 < plot.series.size() ? ", \\" : "");
  }
  return script;
}

std::string script_of(const BarChart& chart) {
  std::string script = "$bars << END\n";
  for (std::size_t i = 0; i < chart.categories.size(); ++i) {
    script += quoted(chart.categories[i]);
    for (const BarChart::Bars& bars : chart.series)
      script += fmt::format(" {:.6g}", bars.heights[i]);
    script += "\n";
  }
  script += "END\n" + axes(chart.title, chart.y_label);
  script +=
      "set key outside top center horizontal noenhanced\nset style data histograms\nset style "
      "histogram clustered gap 1\nset yrange [0:*]\n"
      "set boxwidth 0.9\nset xtics rotate by -35 noenhanced\nset bmargin 9\nplot \\\n";
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    script += fmt::format(
        "  $bars using {}{} title {} fs pattern {} border lc rgb \"{}\" lc rgb "
        "\"{}\"{}\n",
        i + 2, i == 0 ? ":xtic(1)" : "", quoted(chart.series[i].label), i % 7 + 1,
        colours[i % colour_count], colours[i % colour_count],
        i + 1 < chart.series.size() ? ", \\" : "");
  }
  return script;
}

std::string cell_line(const HeatMap& map, std::size_t row, std::size_t column) {
  return fmt::format("{:.10g} {:.10g} {:.6g}\n", map.x[column], map.y[row],
                     map.values[row * map.x.size() + column]);
}

/// The block of data $numbers: the cells whose values are written.
std::string numbers_of(const HeatMap& map) {
  const std::size_t apart = map.cells_per_number;
  std::string block = "$numbers << END\n";
  for (std::size_t row = apart / 2; row < map.y.size(); row += apart)
    for (std::size_t column = apart / 2; column < map.x.size(); column += apart)
      block += cell_line(map, row, column);
  return block + "END\n";
}

std::string colours_of(const HeatMap& map) {
  if (!map.by_sign) return "set palette gray negative\nset cbrange [0:*]\n";
  double greatest = 0;
  for (const double value : map.values) greatest = std::max(greatest, std::abs(value));
  return fmt::format(
      "set palette defined (-1 \"#1565c0\", 0 \"#ffffff\", 1 \"#c62828\")\n"
      "set cbrange [{:.6g}:{:.6g}]\n",
      -greatest, greatest);
}

std::string script_of(const HeatMap& map) {
  std::string script = "$cells << END\n";
  for (std::size_t row = 0; row < map.y.size(); ++row)
    for (std::size_t column = 0; column < map.x.size(); ++column)
      script += cell_line(map, row, column);
  script += "END\n";
  if (map.cells_per_number > 0) script += numbers_of(map);
  script += axes(map.title, map.y_label);
  script += fmt::format("unset key\nset xlabel {} noenhanced\nset cblabel {} noenhanced offset 2\n",
                        quoted(map.x_label), quoted(map.value_label));
  script += colours_of(map) + "set autoscale fix\n";
  if (map.as_image) script += "set size ratio -1\nset yrange [] reverse\n";
  script += "plot $cells with image";
  if (map.cells_per_number > 0)
    script +=
        ", \\\n  $numbers using 1:2:(sprintf(\"%g\", $3)) with labels point pt 7 ps 0.4 offset "
        "0,0.7";
  return script + "\n";
}

}  // namespace

bool has_heights(const BarChart& chart) {
  return std::any_of(chart.series.begin(), chart.series.end(), [](const BarChart::Bars& bars) {
    return std::any_of(bars.heights.begin(), bars.heights.end(), [](double h) { return h != 0; });
  });
}

std::vector<StudyFile> draw(const Plot& plot) {
  const Plot shown = drawable(plot);
  if (shown.series.empty()) return {};
  return run_gnuplot(plot.name, script_of(shown));
}

std::vector<StudyFile> draw(const BarChart& chart) {
  return run_gnuplot(chart.name, script_of(chart));
}

std::vector<StudyFile> draw(const HeatMap& map) {
  return run_gnuplot(map.name, script_of(map));
}

}  // namespace fathom::studies
