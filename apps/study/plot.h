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

// Plots, drawn by the program gnuplot: it is small and well maintained, writes PNG and SVG from
// one description without a display, and readers of a study can change its scripts.

/// A line of a plot. Lines differ by colour, dashes and point marks, so that they can be
/// distinguished in black and white too. A line that coincides with an earlier line is not drawn;
/// the key lists it below the earlier line as "= LABEL".
struct Series {
  std::string label;
  std::vector<std::pair<double, double>> points;
};

/// A series with a point for each row; x and y are members or functions of a row.
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
  /// Points that are not drawn because they have no logarithm still extend the other axis.
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
  /// Red for positive and blue for negative values; otherwise darker for greater values, from 0.
  bool by_sign = false;
  /// Shows an image: the first row is on top, and cells are squares.
  bool as_image = false;
  /// Writes the values of every n-th row and column of cells into the plot, beginning in the middle
  /// of the first n; 0: no values.
  std::size_t cells_per_number = 0;
};

/// NAME.gp, the script that draws the plot, NAME.png and NAME.svg. No files for a plot without
/// points.
/// Fails    OutputError if gnuplot is missing or fails.
std::vector<StudyFile> draw(const Plot& plot);
std::vector<StudyFile> draw(const BarChart& chart);
std::vector<StudyFile> draw(const HeatMap& map);

/// Fails with OutputError if plots are to be drawn and gnuplot is missing. Call it before the work.
void require_gnuplot(const StudyOptions& options);

}  // namespace fathom::studies
