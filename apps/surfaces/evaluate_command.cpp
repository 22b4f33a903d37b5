// fathom evaluate SCENE… --truth SCENE [--camera FILE]

#include <memory>
#include <optional>
#include <vector>

#include "apps/options/camera_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/command.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/progress.h"
#include "apps/shell/values.h"
#include "apps/surfaces/evaluation_report.h"
#include "apps/surfaces/surface_commands.h"
#include "fathom/evaluate.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

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
  return options.read(console);
}

/// A point cloud that was asked for.
class Cloud {
 public:
  /// "" for none.
  explicit Cloud(const std::string& name) {
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
  const Scene reconstruction = arguments.scene.read(console);
  const Scene truth = read_truth(arguments, console);
  std::vector<Camera> cameras;
  if (!arguments.camera.empty()) cameras = read_camera_file(arguments.camera, console);
  TextOutput output(arguments.output);
  Cloud accuracy(arguments.accuracy_points), completeness(arguments.completeness_points);
  SurfaceComparisonOptions options = arguments.comparison;
  options.keep_points =
      !arguments.accuracy_points.empty() || !arguments.completeness_points.empty();
  options.threads = arguments.scene.threads;
  Evaluation evaluation;
  {
    Progress progress(console, "evaluating");
    options.progress = progress.reporter();
    evaluation = evaluate(reconstruction, truth, cameras, options);
  }
  output.write(arguments.json ? app::as_json(evaluation, options.within)
                              : app::as_text(evaluation, options.within));
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
      "evaluate",
      "Measure a reconstructed mesh against the true one: Depth L1, accuracy, completeness",
      "  fathom evaluate mesh.ply --truth room.ply --camera cameras.json --within 0.05\n"
      "  fathom evaluate mesh.ply --truth scan.ply --within 0.01,0.02,0.05 --json");
  arguments->scene.add_to(command);
  command.option("--truth", "SCENE", arguments->truth, "True mesh, in the same world and unit")
      .required();
  command.option("--camera", "FILE", arguments->camera,
                 "Camera file with the views; only surfaces that these cameras see are measured "
                 "(default: whole surfaces, and no depths)");
  command.option("--within", "D,…", into(arguments->comparison.within, parse_thresholds),
                 "Report the share of points nearer than each of these distances");
  command.option("--points", "N", into(arguments->comparison.points, parse_positive),
                 "Number of points on each surface (default 200000)");
  add_cull_option(command, arguments->comparison.cull);
  command.option("--accuracy-points", "PLY", arguments->accuracy_points,
                 "Write the measured points of the reconstruction to this PLY, with their "
                 "distances as `quality`");
  command.option(
      "--completeness-points", "PLY", arguments->completeness_points,
      "Write the measured points of the truth to this PLY, with their distances as `quality`");
  command.flag("--json", arguments->json, "Print JSON");
  add_output_option(command, "FILE", arguments->output,
                    "Write the result to this file (default -, standard output)");
  command.runs([arguments](const Console& console) { return run_evaluate(*arguments, console); });
}

}  // namespace fathom::app
