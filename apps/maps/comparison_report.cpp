#include "apps/maps/comparison_report.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/text/counted.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

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

/// "2 ulp, 0.001 absolute or 1e-06 relative", those that are not 0.
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

}  // namespace

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
  for (const ChannelComparison& channel : maps.channels) text += to_text(channel);
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

}  // namespace fathom::app
