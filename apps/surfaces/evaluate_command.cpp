// fathom evaluate SCENE… --truth SCENE [--camera FILE]

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/options/camera_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/evaluate.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

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

Json to_json(const SurfaceDistances& d, const SurfaceComparisonOptions& options) {
  const std::vector<double>& within = options.within;
  Json json;
  if (d.cloud_points != 0) json["cloud_points"] = d.cloud_points;
  json.update(Json{{"points", d.points}, {"seen", d.seen}});
  if (options.max_distance) json["outliers"] = d.outliers;
  if (d.seen == 0) return json;
  if (d.has_figures()) {
    json.update(Json{{"mean", d.mean},
                     {"rms", d.rms},
                     {"median", d.median},
                     {"p90", d.p90},
                     {"p99", d.p99},
                     {"max", d.max}});
  }
  Json shares = Json::array();
  for (std::size_t i = 0; i < within.size(); ++i)
    shares.push_back({{"within", within[i]}, {"share", d.shares[i]}});
  json["shares"] = shares;
  return json;
}

std::string as_json(const Evaluation& evaluation, const SurfaceComparisonOptions& options) {
  const SurfaceComparison& surfaces = evaluation.surfaces;
  Json scores = Json::array();
  for (std::size_t i = 0; i < options.within.size(); ++i)
    scores.push_back({{"within", options.within[i]}, {"f_score", surfaces.f_scores[i]}});
  const std::optional<double>& overall = surfaces.overall;
  const Json answer{{"depth", evaluation.depth ? to_json(*evaluation.depth) : Json(nullptr)},
                    {"accuracy", to_json(surfaces.accuracy, options)},
                    {"completeness", to_json(surfaces.completeness, options)},
                    {"overall", overall ? Json(*overall) : Json(nullptr)},
                    {"f_scores", scores}};
  return json_answer(answer);
}

struct EvaluateArguments {
  SceneOptions scene;
  std::string truth, camera, output = "-";
  std::string accuracy_points, completeness_points;
  SurfaceComparisonOptions comparison;
  bool json = false;
};

/// Thresholds, "0.05" or "0.01,0.05".
std::vector<double> parse_thresholds(const std::string& text) {
  std::vector<double> thresholds;
  for (const std::string& part : parse_list(text)) thresholds.push_back(parse_scale(part));
  return thresholds;
}

Scene read_truth(const EvaluateArguments& arguments, const Console& console) {
  SceneOptions options = arguments.scene;
  options.files = {arguments.truth};
  return options.read(console, {.clouds = true});
}

/// The file of the measured points, if one was asked for.
class PointsFile {
 public:
  /// "" for none.
  explicit PointsFile(const std::string& name) {
    if (!name.empty()) file_.emplace(name);
  }
  void write(const SurfaceDistances& distances) {
    if (file_) file_->write(ply_of(distances.measured));
  }
  void add_to(std::vector<OutputFile*>& outputs) {
    if (file_) outputs.push_back(&*file_);
  }

 private:
  std::optional<OutputFile> file_;
};

int run_evaluate(const EvaluateArguments& arguments, const Console& console) {
  const Scene reconstruction = arguments.scene.read(console, {.clouds = true});
  const Scene truth = read_truth(arguments, console);
  std::vector<Camera> cameras;
  if (!arguments.camera.empty()) cameras = read_cameras_without_lens(arguments.camera, console);
  TextOutput output(arguments.output);
  PointsFile accuracy(arguments.accuracy_points), completeness(arguments.completeness_points);
  SurfaceComparisonOptions options = arguments.comparison;
  options.keep_points =
      !arguments.accuracy_points.empty() || !arguments.completeness_points.empty();
  options.threads = arguments.scene.threads;
  Evaluation evaluation;
  {
    Progress progress(console, "evaluating");
    evaluation = evaluate(reconstruction, truth, cameras, options, progress.reporter());
  }
  output.write(arguments.json ? as_json(evaluation, options) : to_text(evaluation, options));
  accuracy.write(evaluation.surfaces.accuracy);
  completeness.write(evaluation.surfaces.completeness);
  std::vector<OutputFile*> outputs;
  accuracy.add_to(outputs);
  completeness.add_to(outputs);
  if (output.file()) outputs.push_back(output.file());
  OutputFile::commit_together(outputs);
  output.print();
  return done;
}

}  // namespace

void add_evaluate(Command& program) {
  const auto arguments = std::make_shared<EvaluateArguments>();
  Command& command = program.command(
      "evaluate", description_of_companion("evaluate"),
      "  fathom evaluate mesh.ply --truth room.ply --camera cameras.json --within 0.05\n"
      "  fathom evaluate mesh.ply --truth scan.ply --within 0.01,0.02,0.05 --json\n"
      "  fathom evaluate fused.ply --truth scan.ply --density 0.2 --max-distance 20");
  arguments->scene.add_to(command);
  command
      .option("--truth", "SCENE", arguments->truth,
              "True mesh or point cloud, in the same world and unit")
      .required();
  command.option("--camera", "FILE", arguments->camera,
                 "Camera file with the views; only surfaces that these cameras see are measured "
                 "(default: whole surfaces, and no depths)");
  command.option("--within", "D,…", into(arguments->comparison.within, parse_thresholds),
                 "Report the share of points nearer than each of these distances");
  command.option("--points", "N", into(arguments->comparison.points, parse_positive),
                 "Number of points on each surface (default 200000); every point of a point cloud "
                 "is measured");
  command.option("--density", "D", into(arguments->comparison.density, parse_scale),
                 "Thin the point cloud SCENE first: in file order, drop each point that is nearer "
                 "than D to a point already kept");
  command.option("--truth-density", "D", into(arguments->comparison.truth_density, parse_scale),
                 "Thin the point cloud --truth in the same way");
  command.option("--max-distance", "D", into(arguments->comparison.max_distance, parse_scale),
                 "Treat points at distance D or more as outliers: leave them out of means and "
                 "percentiles, and report their number");
  add_cull_option(command, arguments->comparison.cull);
  command.option("--accuracy-points", "PLY", arguments->accuracy_points,
                 "Write the measured points of the reconstruction to this PLY, with their "
                 "distances as 'quality'");
  command.option(
      "--completeness-points", "PLY", arguments->completeness_points,
      "Write the measured points of the truth to this PLY, with their distances as 'quality'");
  command.flag("--json", arguments->json, "Print JSON");
  add_output_option(command, "FILE", arguments->output,
                    "Write the result to this file (default -, standard output)");
  command.runs([arguments](const Console& console) { return run_evaluate(*arguments, console); });
}

}  // namespace fathom::app
