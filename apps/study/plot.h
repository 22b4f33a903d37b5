#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "apps/study/study.h"
#include "fathom/image/rgb_image.h"

/// Plots and pictures as files.
namespace fathom::studies {

/// Runs a script, which ends with a plot command and sets no terminal, twice: for NAME.png and for
/// NAME.svg, `height` pixels high and 1100 wide. The script itself, as it can be run again, is
/// NAME.gp.
/// Fails    OutputError if gnuplot is missing or fails, with what it said.
std::vector<StudyFile> run_gnuplot(const std::string& name, const std::string& script,
                                   int height = 650);

/// The picture as a PNG file's content.
std::string png_bytes(const RgbImage& image);

/// A picture as a PNG; each pixel becomes a square of `scale` pixels.
/// Fails    OutputError.
StudyFile picture_file(const std::string& name, const RgbImage& image, std::uint32_t scale = 1);

/// Plots, drawn by gnuplot, which is run as a program: it is small, well kept, writes PNG and SVG
/// from one description without a display, and its scripts can be changed by whoever reads a study.

/// A line of a plot. Lines differ by colour, dashes and point marks, so that they can be told apart
/// in black and white too. A line that lies on an earlier one is not drawn: the key names it below
/// that one, as "= LABEL".
struct Series {
  std::string label;
  std::vector<std::pair<double, double>> points;
};

/// A point for each row; x and y are numbers among its members, or functions of it.
template <class Rows, class X, class Y>
Series series_of(std::string label, const Rows& rows, X x, Y y) {
  Series series{std::move(label), {}};
  for (const auto& row : rows) {
    series.points.emplace_back(std::invoke(x, row), std::invoke(y, row));
  }
  return series;
}

/// Points that are not finite, or not positive on a logarithmic axis, are not drawn, nor are series
/// without a point.
struct Plot {
  std::string name;  ///< of its files, without the suffix
  std::string title, x_label, y_label;
  bool logarithmic_x = false, logarithmic_y = false;
  /// Points that are not drawn for want of a logarithm still stretch the other axis.
  bool stretched_by_all = false;
  std::vector<Series> series;
};

/// A group of bars for each category: one bar of every series, stacked or side by side.
struct BarChart {
  std::string name;
  std::string title, y_label;
  std::vector<std::string> categories;
  struct Bars {
    std::string label;
    std::vector<double> heights;  ///< one a category
  };
  std::vector<Bars> series;
};

/// A value for each cell of a grid, with a colour bar.
struct HeatMap {
  std::string name;
  std::string title, x_label, y_label, value_label;
  std::vector<double> x, y;    ///< centres of columns and rows, evenly spaced
  std::vector<double> values;  ///< rows × columns, row by row
  /// Red where it is positive, blue where it is negative; otherwise dark where it is great, from 0.
  bool by_sign = false;
  /// Of an image: its first row is on top, and its cells are squares.
  bool as_image = false;
  /// Cells whose values are written into the plot: a row and a column of so many, from the middle
  /// of the first so many; 0: none.
  std::size_t cells_per_number = 0;
};

/// Whether a bar has a height.
bool has_heights(const BarChart& chart);

/// NAME.gp, the script that draws it, NAME.png and NAME.svg. No file of a plot without a point.
/// Fails    OutputError if gnuplot is missing or fails.
std::vector<StudyFile> draw(const Plot& plot);
std::vector<StudyFile> draw(const BarChart& chart);
std::vector<StudyFile> draw(const HeatMap& map);

/// Fails with OutputError where plots are to be drawn and gnuplot is missing: to be called before
/// the work.
void require_gnuplot(const StudyOptions& options);

}  // namespace fathom::studies
