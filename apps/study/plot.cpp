#include "apps/study/plot.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/files/descriptor.h"
#include "fathom/files/file_bytes.h"
#include "fathom/files/input_file.h"
#include "validation/child/child_process.h"

namespace fathom::studies {
namespace {

/// A file in memory that programs started from here can open by its path. It has no name in any
/// folder, so that nothing is left behind, however this program ends.
class MemoryFile {
 public:
  MemoryFile() : file_(::memfd_create("fathom-plot", 0)) {
    if (!file_.is_open()) throw OutputError("plots: cannot make a file in memory");
  }

  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_.get()); }
  [[nodiscard]] std::string content() const {
    return std::string(files::InputFile(path(), files::InputFile::Reading::copied).text());
  }

 private:
  files::Descriptor file_;
};

/// Runs gnuplot on an argument.
validation::Said run(const std::string& argument) {
  validation::Said said = validation::run_command({"gnuplot", argument});
  if (said.status == 127)
    throw OutputError("gnuplot, which draws the plots, is not there: install gnuplot-nox");
  return said;
}

std::string first_line(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \n");
  return begin == std::string::npos ? "" : text.substr(begin, text.find('\n', begin) - begin);
}

RgbImage enlarged(const RgbImage& image, std::uint32_t scale) {
  RgbImage large(image.width * scale, image.height * scale);
  for (std::uint32_t y = 0; y < large.height; ++y)
    for (std::uint32_t x = 0; x < large.width; ++x) large.at(x, y) = image.at(x / scale, y / scale);
  return large;
}

}  // namespace

void require_gnuplot(const StudyOptions& options) {
  if (options.plots) run("--version");
}

std::string png_bytes(const RgbImage& image) {
  const MemoryFile file;
  write_png(image, file.path());
  return file.content();
}

std::vector<StudyFile> run_gnuplot(const std::string& name, const std::string& script, int height) {
  const auto terminal = [&](const char* kind, const std::string& place) {
    return std::string("set terminal ") + kind + " font \"DejaVu Sans,11\" size 1100," +
           std::to_string(height) + "\nset output \"" + place + "\"\n";
  };
  const auto twice = [&](const std::string& png, const std::string& svg) {
    return terminal("pngcairo", png) + script + terminal("svg", svg) + "replot\nset output\n";
  };
  const MemoryFile input, png, svg;
  const std::string commands = twice(png.path(), svg.path());
  files::write_file(input.path(), std::as_bytes(std::span(commands)));
  const validation::Said said = run(input.path());
  std::vector<StudyFile> files{{name + ".gp", twice(name + ".png", name + ".svg")},
                               {name + ".png", png.content()},
                               {name + ".svg", svg.content()}};
  if (said.status != 0 || files[1].content.empty() || files[2].content.empty())
    throw OutputError("gnuplot cannot draw " + name + ": " + first_line(said.text));
  return files;
}

StudyFile picture_file(const std::string& name, const RgbImage& image, std::uint32_t scale) {
  return {name + ".png", png_bytes(enlarged(image, scale))};
}

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
constexpr const char* series_colours[] = {"#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7",
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

/// Where y is on its axis, from the least of all points, or 0, to the greatest.
class VerticalAxis {
 public:
  explicit VerticalAxis(const Plot& plot) : logarithmic_(plot.logarithmic_y) {
    low_ = logarithmic_ ? std::numeric_limits<double>::infinity() : 0;
    high_ = -std::numeric_limits<double>::infinity();
    for (const Series& series : plot.series) {
      for (const auto& [x, y] : series.points) {
        low_ = std::min(low_, scaled(y));
        high_ = std::max(high_, scaled(y));
      }
    }
  }
  [[nodiscard]] double place(double y) const {
    return high_ > low_ ? (scaled(y) - low_) / (high_ - low_) : 0;
  }

 private:
  [[nodiscard]] double scaled(double y) const { return logarithmic_ ? std::log10(y) : y; }

  bool logarithmic_;
  double low_, high_;
};

/// Whether the lines cannot be told apart: they have the same x, and y differs by less than the
/// width of a line.
bool coincide(const Series& a, const Series& b, const VerticalAxis& axis) {
  constexpr double line_width = 1.0 / 400;
  return std::ranges::equal(a.points, b.points, [&](const auto& p, const auto& q) {
    return p.first == q.first && std::abs(axis.place(p.second) - axis.place(q.second)) < line_width;
  });
}

/// For each series the first one that it coincides with: itself, where it is drawn.
std::vector<std::size_t> drawn_lines(const Plot& plot) {
  const VerticalAxis axis(plot);
  std::vector<std::size_t> drawn(plot.series.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    drawn[i] = i;
    for (std::size_t k = 0; k < i && drawn[i] == i; ++k)
      if (drawn[k] == k && coincide(plot.series[i], plot.series[k], axis)) drawn[i] = k;
  }
  return drawn;
}

/// Colour, dashes and marks of a series.
std::string style_of(std::size_t series) {
  return fmt::format("lw 1.5 dt {} pt {} ps 0.8 lc rgb \"{}\"", series % 5 + 1, series % 13 + 1,
                     series_colours[series % colour_count]);
}

/// The line of a series, and below its name those of the lines that it hides, as "= NAME".
std::string line_of(const Plot& plot, std::size_t series, const std::vector<std::size_t>& drawn) {
  const Series& line = plot.series[series];
  std::string text = fmt::format("  $series{} with linespoints title {} pi {} {}", series,
                                 quoted(line.label), 1 + line.points.size() / 12, style_of(series));
  for (std::size_t i = series + 1; i < drawn.size(); ++i) {
    if (drawn[i] == series)
      text += fmt::format(", \\\n  keyentry with linespoints {} title {}", style_of(series),
                          quoted("= " + plot.series[i].label));
  }
  return text;
}

std::string script_of(const Plot& plot) {
  std::string script;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    script += fmt::format("$series{} << END\n", i);
    for (const auto& [x, y] : plot.series[i].points) {
      script += fmt::format("{} {}\n", x, y);
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
  const std::vector<std::size_t> drawn = drawn_lines(plot);
  std::string lines;
  for (std::size_t i = 0; i < drawn.size(); ++i)
    if (drawn[i] == i) lines += (lines.empty() ? "" : ", \\\n") + line_of(plot, i, drawn);
  return script + "plot \\\n" + lines + "\n";
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
        series_colours[i % colour_count], series_colours[i % colour_count],
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
