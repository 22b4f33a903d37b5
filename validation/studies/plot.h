#pragma once

#include <string>
#include <utility>
#include <vector>

#include "validation/studies/study.h"

/// Plots, drawn by gnuplot, which is run as a program: it is small, well kept, writes PNG and SVG
/// from one description without a display, and its scripts can be changed by whoever reads a study.
namespace fathom::studies {

/// A line of a plot. Lines differ by colour, dashes and point marks, so that they can be told apart
/// in black and white too.
struct Series {
  std::string label;
  std::vector<std::pair<double, double>> points;
};

struct Plot {
  std::string name;  ///< of its files, without the suffix
  std::string title, x_label, y_label;
  bool logarithmic_x = false, logarithmic_y = false;
  std::vector<Series> series;
};

/// Whether there is anything to draw: no series without a point is to be drawn.
bool has_points(const Plot& plot);

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

/// A value for each cell of a grid, dark where it is great, with a colour bar.
struct HeatMap {
  std::string name;
  std::string title, x_label, y_label, value_label;
  std::vector<double> x, y;    ///< centres of columns and rows, evenly spaced
  std::vector<double> values;  ///< rows × columns, row by row
};

/// Whether a bar has a height.
bool has_heights(const BarChart& chart);

/// NAME.gp, the script that draws it, NAME.png and NAME.svg.
/// Fails    OutputError if gnuplot is missing or fails.
std::vector<StudyFile> draw(const Plot& plot);
std::vector<StudyFile> draw(const BarChart& chart);
std::vector<StudyFile> draw(const HeatMap& map);

/// Fails with OutputError where gnuplot is missing: to be called before the work.
void require_gnuplot();

}  // namespace fathom::studies
