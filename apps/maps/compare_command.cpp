#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/options/map_arguments.h"
#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/image/compare.h"
#include "fathom/text/counted.h"
#include "fathom/text/printable.h"

// fathom compare TRUTH OTHER
namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

/// What was compared with what.
struct Comparison {
  std::string truth, other;  ///< the names of the files
  CompareOptions options;
  MapComparison maps;
};

Json to_json(const PixelPosition& pixel) {
  return {pixel.x, pixel.y};
}

Json to_json(const std::optional<PixelPosition>& pixel) {
  return pixel ? to_json(*pixel) : Json(nullptr);
}

Json to_json(const DifferenceSummary& s) {
  return {{"max", s.max},
          {"mean", s.mean},
          {"p50", s.p50},
          {"p90", s.p90},
          {"p99", s.p99},
          {"p99_9", s.p99_9},
          {"worst", to_json(s.worst)}};
}

Json to_json(const DepthMetrics& m) {
  return {{"pixels", m.pixels},  {"left_out", m.left_out}, {"abs_rel", m.abs_rel},
          {"sq_rel", m.sq_rel},  {"rmse", m.rmse},         {"rmse_log", m.rmse_log},
          {"mae", m.mae},        {"delta_1", m.delta_1},   {"delta_2", m.delta_2},
          {"delta_3", m.delta_3}};
}

Json to_json(const DisparityMetrics& m) {
  return {{"pixels", m.pixels},   {"left_out", m.left_out}, {"epe", m.epe},    {"rmse", m.rmse},
          {"bad_0_5", m.bad_0_5}, {"bad_1", m.bad_1},       {"bad_2", m.bad_2}};
}

Json to_json(const ChannelComparison& c) {
  Json json{{"channel", c.truth_channel},
            {"other_channel", c.other_channel},
            {"pixels", c.pixels},
            {"both", c.both},
            {"only_truth", c.only_truth},
            {"only_other", c.only_other},
            {"neither", c.neither},
            {"first_coverage_disagreement", to_json(c.first_coverage_disagreement)},
            {"bit_equal", c.bit_equal},
            {"beyond_tolerance", c.beyond_tolerance},
            {"first_mismatch", to_json(c.first_mismatch)}};
  if (c.identifiers) {
    json["different_identifiers"] = c.different_identifiers;
  } else {
    json["compared"] = c.compared;
    json["incommensurable"] = c.incommensurable;
    json["absolute"] = to_json(c.absolute);
    json["relative"] = to_json(c.relative);
    json["ulp"] = to_json(c.ulp);
  }
  if (c.depth_metrics) json["metrics"] = to_json(*c.depth_metrics);
  if (c.disparity_metrics) json["disparity_metrics"] = to_json(*c.disparity_metrics);
  json["within_tolerance"] = c.within_tolerance();
  json["notes"] = c.notes;
  return json;
}

std::string to_text(const std::optional<PixelPosition>& pixel, const char* what) {
  return pixel ? fmt::format(" ({} at {},{})", what, pixel->x, pixel->y) : "";
}

std::string figures_line(const char* name, const DifferenceSummary& s) {
  return fmt::format("  {:<9} {:>13.6g} {:>13.6g} {:>13.6g} {:>13.6g} {:>13.6g} {:>13.6g}\n", name,
                     s.max, s.mean, s.p50, s.p90, s.p99, s.p99_9);
}

std::string greatest_line(const DifferenceSummary& s, const char* unit) {
  if (s.max == 0) return "";
  return fmt::format("  greatest  {}{} at {},{}\n", s.max, unit, s.worst.x, s.worst.y);
}

std::string pixels_line(std::uint64_t pixels, std::uint64_t left_out) {
  return fmt::format("  metrics   over {}{}\n", text::counted(pixels, "pixel"),
                     left_out == 0 ? "" : fmt::format(", {} left out", left_out));
}

std::string to_text(const DepthMetrics& m) {
  return pixels_line(m.pixels, m.left_out) +
         fmt::format("    AbsRel {:.6g}, SqRel {:.6g}, RMSE {:.6g}, RMSE log {:.6g}, MAE {:.6g}\n",
                     m.abs_rel, m.sq_rel, m.rmse, m.rmse_log, m.mae) +
         fmt::format("    below 1.25: {:.6g} %, 1.25^2: {:.6g} %, 1.25^3: {:.6g} %\n",
                     100 * m.delta_1, 100 * m.delta_2, 100 * m.delta_3);
}

std::string to_text(const DisparityMetrics& m) {
  return pixels_line(m.pixels, m.left_out) +
         fmt::format("    EPE {:.6g}, RMSE {:.6g}\n", m.epe, m.rmse) +
         fmt::format("    off by more than 0.5: {:.6g} %, 1: {:.6g} %, 2: {:.6g} %\n",
                     100 * m.bad_0_5, 100 * m.bad_1, 100 * m.bad_2);
}

/// "2 ulp, 0.001 absolute or 1e-06 relative", without tolerances of 0.
std::string to_text(const CompareOptions& options) {
  std::vector<std::string> tolerances;
  if (options.tolerance_ulp > 0 ||
      (options.tolerance_absolute == 0 && options.tolerance_relative == 0))
    tolerances.push_back(fmt::format("{} ulp", options.tolerance_ulp));
  if (options.tolerance_absolute > 0)
    tolerances.push_back(fmt::format("{} absolute", options.tolerance_absolute));
  if (options.tolerance_relative > 0)
    tolerances.push_back(fmt::format("{} relative", options.tolerance_relative));
  return joined(tolerances, " or ");
}

std::string to_text(const ChannelComparison& c) {
  std::string text = c.truth_channel == c.other_channel
                         ? fmt::format("channel {}\n", text::printable(c.truth_channel))
                         : fmt::format("channel {} against {}\n", text::printable(c.truth_channel),
                                       text::printable(c.other_channel));
  text += fmt::format(
      "  surface   in both {}, in neither {}, in the first only {}, in the other only {}{}\n",
      c.both, c.neither, c.only_truth, c.only_other,
      to_text(c.first_coverage_disagreement, "first"));
  text += fmt::format("  bit-equal {} of {}\n", c.bit_equal, c.both);
  if (c.identifiers) {
    text += fmt::format("  different {}{}\n", c.different_identifiers,
                        to_text(c.first_mismatch, "first"));
  } else {
    text += fmt::format("  {:<9} {:>13} {:>13} {:>13} {:>13} {:>13} {:>13}\n", "", "maximum",
                        "mean", "50 %", "90 %", "99 %", "99.9 %");
    text += figures_line("absolute", c.absolute) + figures_line("relative", c.relative);
    if (c.is_around_zero) {
      text += greatest_line(c.absolute, "");
    } else {
      text += figures_line("ulp", c.ulp) + greatest_line(c.ulp, " ulp");
    }
    if (c.incommensurable > 0) {
      text += fmt::format("  infinite or NaN in one only: {}{}\n", c.incommensurable,
                          to_text(c.first_mismatch, "first"));
    }
  }
  if (c.depth_metrics) text += to_text(*c.depth_metrics);
  if (c.disparity_metrics) text += to_text(*c.disparity_metrics);
  for (const std::string& note : c.notes) text += "  note: " + text::printable(note) + "\n";
  return text;
}

std::string as_json(const Comparison& comparison) {
  const MapComparison& maps = comparison.maps;
  Json channels = Json::array();
  for (const ChannelComparison& channel : maps.channels) channels.push_back(to_json(channel));
  const Json answer{{"truth", comparison.truth},
                    {"other", comparison.other},
                    {"tolerance_ulp", comparison.options.tolerance_ulp},
                    {"tolerance_absolute", comparison.options.tolerance_absolute},
                    {"tolerance_relative", comparison.options.tolerance_relative},
                    {"within_tolerance", maps.within_tolerance()},
                    {"channels", channels},
                    {"only_in_truth", maps.only_in_truth},
                    {"only_in_other", maps.only_in_other},
                    {"notes", maps.notes}};
  return json_answer(answer);
}

std::string as_text(const Comparison& comparison) {
  const MapComparison& maps = comparison.maps;
  std::string text;
  // Files list channels by name, A before Z.
  std::vector<ChannelComparison> channels = maps.channels;
  std::stable_partition(channels.begin(), channels.end(),
                        [](const ChannelComparison& c) { return c.truth_channel != "A"; });
  for (const ChannelComparison& channel : channels) text += to_text(channel);
  if (!maps.only_in_truth.empty()) {
    text +=
        fmt::format("only in the first: {}\n", text::printable(joined(maps.only_in_truth, ", ")));
  }
  if (!maps.only_in_other.empty()) {
    text +=
        fmt::format("only in the other: {}\n", text::printable(joined(maps.only_in_other, ", ")));
  }
  for (const std::string& note : maps.notes) text += "note: " + text::printable(note) + "\n";
  return text + fmt::format("the maps {} within {}\n",
                            maps.within_tolerance() ? "agree" : "do not agree",
                            to_text(comparison.options));
}

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
