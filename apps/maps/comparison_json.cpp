#include <nlohmann/json.hpp>

#include "apps/maps/comparison_report.h"
#include "apps/shell/standard_streams.h"

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

}  // namespace fathom::app
