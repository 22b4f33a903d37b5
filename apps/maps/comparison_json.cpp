#include <nlohmann/json.hpp>

#include "apps/maps/comparison_report.h"
#include "apps/shell/json_answer.h"

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

}  // namespace

std::string as_json(const Comparison& comparison) {
  const MapComparison& maps = comparison.maps;
  Json channels = Json::array();
  for (const ChannelComparison& channel : maps.channels) channels.push_back(to_json(channel));
  const Json answer{{"truth", comparison.truth},
                    {"other", comparison.other},
                    {"tolerance_ulp", comparison.tolerance_ulp},
                    {"within_tolerance", maps.within_tolerance()},
                    {"channels", channels},
                    {"only_in_truth", maps.only_in_truth},
                    {"only_in_other", maps.only_in_other},
                    {"notes", maps.notes}};
  return json_answer(answer);
}

}  // namespace fathom::app
