#include "apps/surfaces/evaluation_report.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "apps/shell/standard_streams.h"
#include "fathom/text/counted.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

std::string to_text(const DepthAgreement& d) {
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

std::string to_text(const char* name, const SurfaceDistances& d) {
  std::string line = fmt::format("{:<13} {:>9} {:>9}", name, d.points, d.seen);
  for (const double figure : {d.mean, d.rms, d.median, d.p90, d.p99, d.max})
    line += d.seen == 0 ? fmt::format(" {:>11}", "-") : fmt::format(" {:>11.6g}", figure);
  return line + (d.seen == 0 ? "" : shares_text(d.shares)) + "\n";
}

Json to_json(const DepthAgreement& d) {
  const DepthMetrics& m = d.metrics;
  return {{"views", d.views},
          {"pixels",
           {{"both", d.both},
            {"only_truth", d.only_truth},
            {"only_reconstruction", d.only_reconstruction}}},
          {"l1", m.mae},
          {"rmse", m.rmse},
          {"rmse_log", m.rmse_log},
          {"abs_rel", m.abs_rel},
          {"sq_rel", m.sq_rel},
          {"delta_1", m.delta_1},
          {"delta_2", m.delta_2},
          {"delta_3", m.delta_3},
          {"mean_of_views",
           {{"all_pixels", d.l1_of_all_pixels},
            {"truth_pixels", d.l1_of_truth_pixels},
            {"views_with_truth", d.views_of_truth}}}};
}

Json to_json(const SurfaceDistances& d, const std::vector<double>& within) {
  Json json{{"points", d.points}, {"seen", d.seen}};
  if (d.seen == 0) return json;
  json.update(Json{{"mean", d.mean},
                   {"rms", d.rms},
                   {"median", d.median},
                   {"p90", d.p90},
                   {"p99", d.p99},
                   {"max", d.max}});
  Json shares = Json::array();
  for (std::size_t i = 0; i < within.size(); ++i)
    shares.push_back({{"within", within[i]}, {"share", d.shares[i]}});
  json["shares"] = shares;
  return json;
}

}  // namespace

std::string as_text(const Evaluation& evaluation, const std::vector<double>& within) {
  const SurfaceComparison& surfaces = evaluation.surfaces;
  std::string text = evaluation.depth ? to_text(*evaluation.depth) : "";
  text += heading(within);
  text += to_text("accuracy", surfaces.accuracy);
  text += to_text("completeness", surfaces.completeness);
  if (!within.empty())
    text += fmt::format("{:<105}", "F-score") + shares_text(surfaces.f_scores) + "\n";
  return text;
}

std::string as_json(const Evaluation& evaluation, const std::vector<double>& within) {
  const SurfaceComparison& surfaces = evaluation.surfaces;
  Json scores = Json::array();
  for (std::size_t i = 0; i < within.size(); ++i)
    scores.push_back({{"within", within[i]}, {"f_score", surfaces.f_scores[i]}});
  const Json answer{{"depth", evaluation.depth ? to_json(*evaluation.depth) : Json(nullptr)},
                    {"accuracy", to_json(surfaces.accuracy, within)},
                    {"completeness", to_json(surfaces.completeness, within)},
                    {"f_scores", scores}};
  return json_answer(answer);
}

}  // namespace fathom::app
