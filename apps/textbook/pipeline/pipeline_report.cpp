#include "apps/textbook/pipeline/pipeline_report.h"

#include <nlohmann/json.hpp>

#include "apps/shell/standard_streams.h"
#include "fathom/pipeline/geometry/window_transform.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const pipeline::PipelineStatistics& s) {
  return {{"triangles", s.triangles},
          {"not_finite", s.not_finite},
          {"clipped_away", s.clipped_away},
          {"clipped", s.clipped},
          {"degenerate", s.degenerate},
          {"culled", s.culled},
          {"drawn", s.drawn},
          {"lines", s.lines},
          {"points", s.points},
          {"turned_by_snapping", s.turned_by_snapping},
          {"fragments", s.fragments},
          {"depth_passed", s.depth_passed},
          {"shaded", s.shaded},
          {"blocks_skipped", s.blocks_skipped},
          {"blocks_full", s.blocks_full},
          {"near", s.near},
          {"far", s.far},
          {"facings",
           {{"compared", s.facings.compared},
            {"front_in_world", s.facings.front_in_world},
            {"front_in_ndc", s.facings.front_in_ndc},
            {"front_in_window", s.facings.front_in_window},
            {"disagreeing", s.facings.disagreeing}}}};
}

Json to_json(const pipeline::PainterStatistics& s) {
  return {{"z_disjoint", s.z_disjoint},
          {"x_disjoint", s.settled[0]},
          {"y_disjoint", s.settled[1]},
          {"behind_plane", s.settled[2]},
          {"before_plane", s.settled[3]},
          {"projections_disjoint", s.settled[4]},
          {"moved", s.moved},
          {"splits", s.splits},
          {"comparisons", s.comparisons}};
}

Json to_json(const PipelineReport& report) {
  Json json{{"map", report.map},
            {"engine", "pipeline"},
            {"width", report.width},
            {"height", report.height}};
  json.update(to_json(report.statistics));
  if (report.painter) json["painter"] = to_json(*report.painter);
  return json;
}

}  // namespace

std::string as_json(const std::vector<PipelineReport>& maps) {
  Json list = Json::array();
  for (const PipelineReport& map : maps) list.push_back(to_json(map));
  return json_answer(list.size() == 1 ? list[0] : list);
}

void warn_of_windows(const Camera& camera, const pipeline::PipelineOptions& stages,
                     const Console& console) {
  if (pipeline::is_stretched(camera, stages))
    console.warn("the viewport's width : height is not the camera's: the picture is stretched");
  if (pipeline::drawable_window(camera, stages).is_empty())
    console.warn("viewport and scissor box leave no pixel of the image: the map is background");
}

}  // namespace fathom::app
