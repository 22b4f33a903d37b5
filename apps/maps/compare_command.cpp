// fathom compare TRUTH OTHER

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "apps/shell/known_files.h"
#include "apps/shell/numbers.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "fathom/image/compare.h"
#include "fathom/image/map_files.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

struct CompareArguments {
  std::string truth, other;
  std::string tolerance = "0", channel, other_channel, truth_background, other_background;
  std::string json, heatmap;
};

CompareOptions compare_options(const CompareArguments& arguments) {
  CompareOptions options;
  options.tolerance_ulp = parse_number("--tolerance-ulp", arguments.tolerance);
  if (options.tolerance_ulp < 0) {
    throw UsageError("--tolerance-ulp: '" + arguments.tolerance + "' is negative");
  }
  options.channel = arguments.channel;
  options.other_channel = arguments.other_channel;
  if (!arguments.truth_background.empty()) {
    options.truth_background = parse_number("--truth-background", arguments.truth_background);
  }
  if (!arguments.other_background.empty()) {
    options.other_background = parse_number("--other-background", arguments.other_background);
  }
  return options;
}

std::string to_text(const std::optional<PixelPosition>& pixel, const char* what) {
  return pixel ? fmt::format(" ({} at {},{})", what, pixel->x, pixel->y) : "";
}

std::string figures_line(const char* name, const DifferenceSummary& s) {
  return fmt::format("  {:<9} {:>13.6g} {:>13.6g} {:>13.6g} {:>13.6g} {:>13.6g} {:>13.6g}\n", name,
                     s.max, s.mean, s.p50, s.p90, s.p99, s.p99_9);
}

std::string to_text(const ChannelComparison& c) {
  std::string text = c.truth_channel == c.other_channel
                         ? fmt::format("channel {}\n", c.truth_channel)
                         : fmt::format("channel {} against {}\n", c.truth_channel, c.other_channel);
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
    text += figures_line("absolute", c.absolute) + figures_line("relative", c.relative) +
            figures_line("ulp", c.ulp);
    if (c.ulp.max > 0) {
      text += fmt::format("  greatest  {} ulp at {},{}\n", c.ulp.max, c.ulp.worst.x, c.ulp.worst.y);
    }
    if (c.incommensurable > 0) {
      text += fmt::format("  infinite or NaN in one only: {}{}\n", c.incommensurable,
                          to_text(c.first_mismatch, "first"));
    }
  }
  for (const std::string& note : c.notes) text += "  note: " + note + "\n";
  return text;
}

std::string to_text(const MapComparison& comparison, double tolerance) {
  std::string text;
  for (const ChannelComparison& channel : comparison.channels) text += to_text(channel);
  if (!comparison.only_in_truth.empty()) {
    text += fmt::format("only in the first: {}\n", fmt::join(comparison.only_in_truth, ", "));
  }
  if (!comparison.only_in_other.empty()) {
    text += fmt::format("only in the other: {}\n", fmt::join(comparison.only_in_other, ", "));
  }
  for (const std::string& note : comparison.notes) text += "note: " + note + "\n";
  return text + fmt::format("the maps {} within {} ulp\n",
                            comparison.within_tolerance() ? "agree" : "do not agree", tolerance);
}

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
  json["within_tolerance"] = c.within_tolerance();
  json["notes"] = c.notes;
  return json;
}

std::string as_json(const MapComparison& comparison, const CompareArguments& arguments,
                    double tolerance) {
  Json channels = Json::array();
  for (const ChannelComparison& channel : comparison.channels) channels.push_back(to_json(channel));
  const Json answer{{"truth", arguments.truth},
                    {"other", arguments.other},
                    {"tolerance_ulp", tolerance},
                    {"within_tolerance", comparison.within_tolerance()},
                    {"channels", channels},
                    {"only_in_truth", comparison.only_in_truth},
                    {"only_in_other", comparison.only_in_other},
                    {"notes", comparison.notes}};
  return answer.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

int run_compare(const CompareArguments& arguments) {
  const CompareOptions options = compare_options(arguments);
  if (!arguments.heatmap.empty()) expect_png("--heatmap", arguments.heatmap);
  note_input(arguments.truth);
  note_input(arguments.other);
  const DepthMap truth = read_map(arguments.truth);
  const DepthMap other = read_map(arguments.other);
  const MapComparison comparison = compare_maps(truth, other, options);

  std::vector<OutputFile> outputs;
  outputs.reserve(2);
  const std::string json = as_json(comparison, arguments, options.tolerance_ulp);
  if (!arguments.json.empty() && arguments.json != "-") {
    outputs.emplace_back(arguments.json).write(json);
  }
  if (!arguments.heatmap.empty()) {
    const RgbImage picture = draw_differences(truth, other, options);
    outputs.emplace_back(arguments.heatmap).write([&](const std::filesystem::path& path) {
      write_png(picture, path);
    });
  }
  for (OutputFile& output : outputs) output.commit();
  print(arguments.json == "-" ? json : to_text(comparison, options.tolerance_ulp));
  return comparison.within_tolerance() ? done : answer_is_no;
}

}  // namespace

void add_compare(Program& program) {
  const auto arguments = std::make_shared<CompareArguments>();
  CLI::App* command = program.add_command(
      "compare", "Compare two maps pixel by pixel; exit status 1 if they differ",
      "  fathom compare spot.exr other.exr\n"
      "  fathom compare spot.exr other.pfm --tolerance-ulp 2 --json report.json\n"
      "  fathom compare spot.exr blender.exr --heatmap differences.png");
  command->add_option("TRUTH", arguments->truth, "The map that is right")->required();
  command->add_option("OTHER", arguments->other, "The map that is held against it")->required();
  command->add_option("--tolerance-ulp", arguments->tolerance,
                      "Accept differences of so many units in the last place (default 0)");
  command->add_option("--json", arguments->json,
                      "Write the figures to this file (- is standard output, without the text)");
  command->add_option("--heatmap", arguments->heatmap, "Draw the differences (PNG)");
  command->add_option("--channel", arguments->channel, "Compare this channel only");
  command->add_option("--other-channel", arguments->other_channel,
                      "Its name in OTHER, where that differs");
  command->add_option("--truth-background", arguments->truth_background,
                      "The depth that means background in TRUTH (default: detected)");
  command->add_option("--other-background", arguments->other_background, "The same for OTHER");
  command->callback(
      [arguments, &program] { program.run = [arguments] { return run_compare(*arguments); }; });
}

}  // namespace fathom::app
