#include <fmt/core.h>

#include <optional>
#include <string>
#include <vector>

#include "fathom/evaluate.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/text/counted.h"

namespace fathom {
namespace {

std::string depth_text(const DepthAgreement& d) {
  const DepthMetrics& m = d.metrics;
  std::string text =
      fmt::format("Depth L1 {:.6g} over the {} in {} that show both surfaces\n", m.mae,
                  text::counted(d.both, "pixel"), text::counted(d.views, "view"));
  text += fmt::format("  RMSE {:.6g}, AbsRel {:.6g}; below 1.25: {:.6g} %\n", m.rmse, m.abs_rel,
                      100 * m.delta_1);
  text += fmt::format("  {} more show only the truth, {} only the reconstruction\n", d.only_truth,
                      d.only_reconstruction);
  text += fmt::format(
      "  with these as depth 0, the mean of the views: {:.6g} over all pixels, {:.6g} over those "
      "of the truth\n",
      d.l1_of_all_pixels, d.l1_of_truth_pixels);
  return text;
}

std::string threshold_text(double within) {
  return fmt::format("< {:.6g}", within);
}

std::string heading(const std::vector<double>& within) {
  std::string line = fmt::format("{:<13} {:>9} {:>9}", "", "points", "seen");
  for (const char* figure : {"mean", "RMS", "median", "90 %", "99 %", "max"})
    line += fmt::format(" {:>11}", figure);
  for (const double w : within) line += fmt::format(" {:>11}", threshold_text(w));
  return line + "\n";
}

std::string shares_text(const std::vector<double>& shares) {
  std::string text;
  for (const double share : shares) text += fmt::format(" {:>9.3f} %", 100 * share);
  return text;
}

/// What a side is if it is a point cloud, and what thinning has left.
std::string note_on(const char* side, const SurfaceDistances& d, std::optional<double> density) {
  if (d.cloud_points == 0) return "";
  std::string text =
      fmt::format("The {} is a cloud of {}", side, text::counted(d.cloud_points, "point"));
  if (density) text += fmt::format("; {} left at density {:.6g}", d.points, *density);
  return text + "\n";
}

std::string outliers_text(const SurfaceComparison& surfaces, double max_distance) {
  return fmt::format(
      "Outliers, {:.6g} or farther away: {} for accuracy, {} for completeness; only the shares "
      "count them\n",
      max_distance, surfaces.accuracy.outliers, surfaces.completeness.outliers);
}

std::string distances_text(const char* name, const SurfaceDistances& d) {
  std::string line = fmt::format("{:<13} {:>9} {:>9}", name, d.points, d.seen);
  for (const double figure : {d.mean, d.rms, d.median, d.p90, d.p99, d.max})
    line += !d.has_figures() ? fmt::format(" {:>11}", "-") : fmt::format(" {:>11.6g}", figure);
  return line + (d.seen == 0 ? "" : shares_text(d.shares)) + "\n";
}

}  // namespace

std::string to_text(const Evaluation& evaluation, const SurfaceComparisonOptions& options) {
  const StandardArithmetic standard;
  const SurfaceComparison& surfaces = evaluation.surfaces;
  std::string text = evaluation.depth ? depth_text(*evaluation.depth) : "";
  text += note_on("reconstruction", surfaces.accuracy, options.density);
  text += note_on("truth", surfaces.completeness, options.truth_density);
  text += heading(options.within);
  text += distances_text("accuracy", surfaces.accuracy);
  text += distances_text("completeness", surfaces.completeness);
  if (const auto& mean = surfaces.overall)
    text += fmt::format("{:<33} {:>11.6g}\n", "overall", *mean);
  if (!options.within.empty())
    text += fmt::format("{:<105}", "F-score") + shares_text(surfaces.f_scores) + "\n";
  if (options.max_distance) text += outliers_text(surfaces, *options.max_distance);
  return text;
}

}  // namespace fathom
