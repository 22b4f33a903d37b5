// fathom compare TRUTH OTHER

#include <memory>
#include <optional>
#include <vector>

#include "apps/maps/comparison_report.h"
#include "apps/maps/map_commands.h"
#include "apps/options/map_arguments.h"
#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "apps/shell/output_file.h"
#include "apps/shell/output_place.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/image/compare.h"

namespace fathom::app {
namespace {

struct CompareArguments {
  std::string truth, other;
  CompareOptions options;
  std::string json, heatmap;
  DifferenceMeasure heatmap_measure = DifferenceMeasure::absolute;
  bool metrics = false, disparity_metrics = false;
};

double parse_tolerance(const std::string& text) {
  const double tolerance = parse_number(text);
  if (tolerance < 0) throw UsageError("'" + text + "' is negative");
  return tolerance;
}

DifferenceMeasure parse_measure(const std::string& text) {
  return parse_word<DifferenceMeasure>(text, {{"scene", DifferenceMeasure::absolute},
                                              {"relative", DifferenceMeasure::relative},
                                              {"ulp", DifferenceMeasure::ulp}});
}

int run_compare(const CompareArguments& arguments) {
  CompareOptions options = arguments.options;
  if (arguments.metrics) options.metrics = Metrics::by_channel;
  if (arguments.disparity_metrics) options.metrics = Metrics::of_disparity;
  note_input(arguments.truth);
  note_input(arguments.other);
  TextOutput json(arguments.json);
  std::optional<OutputFile> heatmap;
  if (!arguments.heatmap.empty()) heatmap.emplace(arguments.heatmap);
  const DepthMap truth = read_map_argument(arguments.truth);
  const DepthMap other = read_map_argument(arguments.other);
  const Comparison comparison{arguments.truth, arguments.other, options,
                              compare_maps(truth, other, options)};

  std::vector<OutputFile*> outputs;
  json.write(as_json(comparison));
  if (json.file() != nullptr) outputs.push_back(json.file());
  if (heatmap) {
    const RgbImage picture = draw_differences(truth, other, options, arguments.heatmap_measure);
    heatmap->write([&](const std::filesystem::path& path) { write_png(picture, path); });
    outputs.push_back(&*heatmap);
  }
  json.print();
  if (arguments.json != "-") print(as_text(comparison));
  OutputFile::commit_together(outputs);
  return comparison.maps.within_tolerance() ? done : answer_is_no;
}

}  // namespace

void add_compare(Command& program) {
  const auto arguments = std::make_shared<CompareArguments>();
  CompareOptions& options = arguments->options;
  Command& command =
      program.command("compare", "Compare two maps pixel by pixel; exit status 1 if they differ",
                      "  fathom compare spot.exr other.exr\n"
                      "  fathom compare spot.exr other.pfm --tolerance-ulp 2 --json report.json\n"
                      "  fathom compare spot.exr blender.exr --heatmap differences.png\n"
                      "  fathom compare truth.exr network.npy --metrics --absolute 0.001 --json -\n"
                      "  fathom compare disp0.pfm mine.pfm --disparity-metrics");
  command.argument("TRUTH", arguments->truth, "Map with the true values").required();
  command.argument("OTHER", arguments->other, "Map to check").required();
  command.option("--tolerance-ulp", "N", into(options.tolerance_ulp, parse_tolerance),
                 "Accept differences of up to N units in the last place (default 0)");
  command.option("--absolute", "D", into(options.tolerance_absolute, parse_tolerance),
                 "Accept absolute differences of up to D, in the unit of the channel, as well");
  command.option("--relative", "R", into(options.tolerance_relative, parse_tolerance),
                 "Accept relative differences of up to R as well");
  command.flag(
      "--metrics", arguments->metrics,
      "Add the metrics of benchmarks, over the pixels where both maps show a surface: AbsRel, "
      "SqRel, RMSE, RMSE log, MAE and the shares below 1.25, 1.25^2 and 1.25^3; for a channel "
      "'disparity': EPE, RMSE and the shares off by more than 0.5, 1 and 2 pixels");
  command.flag(
      "--disparity-metrics", arguments->disparity_metrics,
      "Add the metrics of disparities, whatever the name of the channel (a PFM has no names)");
  command.option("--json", "FILE", arguments->json,
                 "Write the figures as JSON to this file (- is standard output, without the text)");
  command.option(
      "--heatmap", "PNG", into(arguments->heatmap, parse_png_name),
      "Draw the differences of --channel (default Z, or the first depth channel) to this PNG");
  command.option("--heatmap-unit", "NAME", into(arguments->heatmap_measure, parse_measure),
                 "Unit of the colours of --heatmap: scene (default; the unit of the channel), "
                 "relative or ulp (units in the last place)");
  command.option("--channel", "NAME", options.channel, "Compare this channel only");
  command.option("--other-channel", "NAME", options.other_channel,
                 "Name of the channel in OTHER, if different");
  command.option("--truth-background", "D", into(options.truth_background, parse_number),
                 "Depth of the background in TRUTH (default: detected)");
  command.option("--other-background", "D", into(options.other_background, parse_number),
                 "Depth of the background in OTHER (default: detected)");
  command.answers_on_standard_output();
  command.runs([arguments](const Console&) { return run_compare(*arguments); });
}

}  // namespace fathom::app
