#include "apps/render/render_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "apps/options/depth_format_options.h"
#include "apps/shell/standard_streams.h"
#include "fathom/image/depth_map.h"
#include "fathom/rendering/rendered.h"
#include "fathom/rendering/segment_channels.h"
#include "fathom/scene/scene_segments.h"
#include "fathom/text/counted.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const TierCounts& counts) {
  return {{"interval", counts.interval}, {"exact", counts.exact}};
}

/// For each decision that the engine counts, the arithmetic that settles it.
Json decided_by(Engine engine) {
  Json json = Json::object();
  for (const Deciders& d : deciders_of(engine)) {
    if (d.interval.empty()) continue;
    json[std::string(d.decision)] = {{"interval", d.interval}, {"exact", d.exact}};
  }
  return json;
}

/// All counts except two that are parts of other counts.
Json to_json(const RenderStatistics& statistics) {
  Json json = Json::object(), decisions = Json::object();
  for_each_count([&](const std::string& name, auto member) {
    const auto& count = statistics.*member;
    if constexpr (std::is_same_v<decltype(count), const TierCounts&>) {
      decisions[name] = to_json(count);
    } else if (name != "double_word_roundings" && name != "areas_with_exact_ends") {
      json[name] = count;
    }
  });
  json["decisions"] = std::move(decisions);
  return json;
}

Json to_json(const DepthBufferReport& report) {
  Json json = json_of(report.format);
  json["encoded"] = {{"binary64", report.seen.by_binary64},
                     {"double_words", report.seen.by_double_words},
                     {"exact", report.seen.by_exact_numbers}};
  if (report.against_exact) json["fighting_pixels"] = report.seen.fighting;
  return json;
}

Json to_json(const MapReport& report) {
  Json json{{"map", report.map},
            {"engine", name_of(report.engine)},
            {"width", report.width},
            {"height", report.height}};
  json.update(to_json(report.statistics));
  json["decided_by"] = decided_by(report.engine);
  Json seconds{{"read", report.seconds.read},
               {"render", report.seconds.render},
               {"write", report.seconds.write}};
  if (report.verification) {
    json["verified"] = report.verification->verified;
    json["nearly_unsettled"] = report.verification->nearly_unsettled;
    json["differing"] = report.verification->differing;
    seconds["verify"] = report.seconds.verify;
  }
  if (report.depth_buffer) seconds["depth_format"] = report.seconds.depth_format;
  json["seconds"] = std::move(seconds);
  if (report.depth_buffer) json["depth_format"] = to_json(*report.depth_buffer);
  return json;
}

}  // namespace

void warn_of(const RenderStatistics& statistics, const Console& console) {
  if (statistics.triangles == 0) {
    console.warn("the scene has no triangle: the map is background");
  } else if (statistics.degenerate_triangles > 0) {
    console.warn(fmt::format("{} of {} {}", statistics.degenerate_triangles,
                             text::counted(statistics.triangles, "triangle"),
                             statistics.degenerate_triangles == 1
                                 ? "is degenerate or seen edge on and covers nothing"
                                 : "are degenerate or seen edge on and cover nothing"));
  }
}

void warn_of_missing_segments(const TriangleSource& triangles, const std::vector<Channel>& channels,
                              const Console& console) {
  const std::vector<Segmentation> wanted = segmentations_of(channels);
  if (wanted.empty()) return;
  const SceneSegments segments(triangles, wanted);
  for (const Segmentation by : wanted) {
    if (!segments.is_empty(by)) continue;
    const std::string_view name = description_of(channel_of(by)).name;
    console.warn(fmt::format("no triangle of the scene has a {}: channel {} is {} at all surfaces",
                             name, name, no_segment));
  }
}

std::string hint_for_first_exr(const std::string& map, const MapPlan& plan) {
  namespace fs = std::filesystem;
  const bool has_depth = std::ranges::count(plan.rendering.channels, Channel::Z) > 0;
  if (plan.format != MapFormat::exr || !has_depth || !plan.storage.channel_names.empty()) return "";
  const fs::path folder = fs::absolute(map).parent_path();
  std::error_code unreadable;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unreadable)) {
    if (map_format_of(entry.path()) == MapFormat::exr) return "";
  }
  return "hint: OpenCV and imageio show zeros for channel Z of an EXR: '--channels Z "
         "--channel-name "
         "Z=Y' writes it for them";
}

std::string hint_for_lens(const Camera& camera, const MapPlan& plan) {
  const auto has = [&](Channel channel) {
    return std::ranges::count(plan.rendering.channels, channel) > 0;
  };
  const bool gives_points = !bends_rays(camera.projection) || has(Channel::P);
  if (gives_points || !has(Channel::Z) || !holds_all_channels(plan.format)) return "";
  return "hint: a point cloud of a map with a lens needs channel P: '--channels Z,P'";
}

std::string as_json(const std::vector<MapReport>& maps) {
  Json list = Json::array();
  for (const MapReport& map : maps) list.push_back(to_json(map));
  return json_answer(list.size() == 1 ? list[0] : list);
}

}  // namespace fathom::app
