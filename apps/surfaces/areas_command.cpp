// fathom areas SCENE… --directions FILE | --points FILE | --camera FILE

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/commands.h"
#include "apps/options/camera_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "apps/surfaces/area_items.h"
#include "apps/surfaces/csv_field.h"
#include "apps/surfaces/light_list.h"
#include "fathom/area/areas.h"
#include "fathom/failures/errors.h"
#include "fathom/text/printable.h"
#include "fathom/threads/threads.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

struct AreasArguments {
  SceneOptions scene;
  CameraOptions camera;
  std::string directions, points;
  AreaItemKind by = AreaItemKind::object;
  AreaCentroid centroid = AreaCentroid::across;
  Cull cull = Cull::none;
  bool nonzero = false, json = false;
  std::string output = "-";
};

/// The lights, one after the other: directions, points or cameras.
struct Lights {
  LightList list;
  std::vector<Camera> cameras;
  bool are_points = false;

  [[nodiscard]] std::size_t size() const {
    return cameras.empty() ? list.lights.size() : cameras.size();
  }
  [[nodiscard]] std::vector<LitArea> areas(const TriangleSource& triangles, std::size_t light,
                                           const AreaOptions& options) const {
    if (!cameras.empty()) return areas_from_camera(triangles, cameras[light], options);
    const std::array<double, 3>& numbers = list.lights[light].numbers;
    return are_points ? areas_from_point(triangles, numbers, options)
                      : areas_in_direction(triangles, numbers, options);
  }
};

Lights lights_of(const AreasArguments& a, const Scene& scene, const Console& console) {
  Lights lights;
  if (!a.directions.empty() || !a.points.empty()) {
    lights.are_points = a.directions.empty();
    lights.list = read_lights(lights.are_points ? a.points : a.directions);
  } else {
    lights.cameras = a.camera.get(scene, a.scene.limits, console);
  }
  return lights;
}

const char* name_of(LitSide side) {
  switch (side) {
    case LitSide::front:
      return "front";
    case LitSide::back:
      return "back";
    case LitSide::edge:
      break;
  }
  return "edge";
}

template <class Number>
std::string field_of(const std::optional<Number>& number) {
  return number ? fmt::format("{}", *number) : "";
}

constexpr std::array own_columns{"direction", "name", "kind",      "number",  "object",
                                 "face",      "side", "projected", "visible", "fraction",
                                 "lit",       "x",    "y",         "z"};

/// The name that a column of the lights' file has in the table.
std::string column(const std::string& heading) {
  const std::string name = text::printable(heading);
  const bool is_own = std::ranges::find(own_columns, name) != own_columns.end();
  return is_own ? "light_" + name : name;
}

/// Writes rows, light by light.
class AreaTable {
 public:
  AreaTable(const AreasArguments& arguments, const AreaItems& items, const Lights& lights)
      : arguments_(arguments), items_(items), lights_(lights) {}

  [[nodiscard]] std::string beginning() const {
    if (arguments_.json) return "[";
    std::string line;
    for (const char* key : own_columns) line += std::string(line.empty() ? "" : ",") + key;
    for (const std::string& heading : lights_.list.headings) line += "," + quoted(column(heading));
    return line + "\n";
  }
  [[nodiscard]] std::string rows(std::size_t light, const std::vector<LitArea>& areas) const {
    std::string text;
    for (std::size_t k = 0; k < areas.size(); ++k) {
      if (arguments_.nonzero && areas[k].lit == 0) continue;
      text += arguments_.json ? as_json(light, items_.items[k], areas[k])
                              : as_csv(light, items_.items[k], areas[k]);
    }
    return text;
  }
  /// The whole table, of the rows of all lights.
  [[nodiscard]] std::string whole(std::string rows) const {
    if (!arguments_.json) return beginning() + rows;
    if (!rows.empty()) rows.pop_back();  // the last comma
    return beginning() + rows + "\n]\n";
  }

 private:
  [[nodiscard]] std::string as_csv(std::size_t light, const AreaItem& item,
                                   const LitArea& area) const {
    std::string line =
        fmt::format("{},{},{},{},{},{},{},{},{},{},{}", light, quoted(item.name),
                    name_of(arguments_.by), item.number, field_of(item.object), field_of(item.face),
                    area.side ? name_of(*area.side) : "", field_of(area.projected),
                    field_of(area.visible), field_of(area.fraction), area.lit);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      line += area.centroid ? fmt::format(",{}", (*area.centroid)[axis]) : ",";
    }
    if (!lights_.list.lights.empty()) {
      for (const std::string& field : lights_.list.lights[light].fields)
        line += "," + quoted(field);
    }
    return line + "\n";
  }

  [[nodiscard]] std::string as_json(std::size_t light, const AreaItem& item,
                                    const LitArea& area) const {
    const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(nullptr); };
    Json row{{"direction", light},
             {"name", text::printable(item.name)},
             {"kind", name_of(arguments_.by)},
             {"number", item.number},
             {"object", or_null(item.object)},
             {"face", or_null(item.face)},
             {"side", area.side ? Json(name_of(*area.side)) : Json(nullptr)},
             {"projected", or_null(area.projected)},
             {"visible", or_null(area.visible)},
             {"fraction", or_null(area.fraction)},
             {"lit", area.lit}};
    constexpr std::array axes{"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      row[axes[axis]] = area.centroid ? Json((*area.centroid)[axis]) : Json(nullptr);
    }
    const auto& headings = lights_.list.headings;
    for (std::size_t k = 0; k < headings.size(); ++k) {
      row[column(headings[k])] = text::printable(lights_.list.lights[light].fields[k]);
    }
    return "\n" + row.dump() + ",";
  }

  const AreasArguments& arguments_;
  const AreaItems& items_;
  const Lights& lights_;
};

/// The rows of all lights. Several lights are measured at the same time, each by one thread.
std::string measured(const Scene& scene, const Lights& lights, const AreasArguments& a,
                     const AreaItems& items, const AreaTable& table, const Console& console) {
  AreaOptions options;
  options.cull = a.cull;
  options.centroid = a.centroid;
  options.threads = lights.size() > 1 ? 1 : a.scene.threads;
  options.groups = items.of_triangle;
  options.group_count = static_cast<std::uint32_t>(items.items.size());
  const TriangleSource triangles(scene);
  std::vector<std::string> rows(lights.size());
  app::Progress shown(console, "measuring");
  const auto report = shown.reporter();
  fathom::Progress progress(report, lights.size());
  with_threads(a.scene.threads, [&] {
    in_parallel(lights.size(), [&](std::size_t light) {
      rows[light] = table.rows(light, lights.areas(triangles, light, options));
      progress.part_done();
    });
  });
  std::string all;
  for (const std::string& some : rows) all += some;
  return all;
}

int run_areas(const AreasArguments& a, const Console& console) {
  const bool has_segments = a.by == AreaItemKind::material || a.by == AreaItemKind::group ||
                            a.by == AreaItemKind::part || a.by == AreaItemKind::label;
  const Scene scene = a.scene.read(console, {.segments = has_segments});
  const Lights lights = lights_of(a, scene, console);
  TextOutput output(a.output);
  const AreaItems items = area_items(scene, a.by);
  const AreaTable table(a, items, lights);
  output.finish(table.whole(measured(scene, lights, a, items, table, console)));
  return done;
}

}  // namespace

void add_areas(Command& program) {
  const auto arguments = std::make_shared<AreasArguments>();
  Command& command = program.command(
      "areas", "Measure the areas that a sun, a lamp or a camera sees, exactly, without pixels",
      "  fathom areas house.obj --directions suns.csv --by face -o areas.csv\n"
      "  fathom areas satellite.json --directions suns.csv --by object --json\n"
      "  fathom areas room.json --points lamps.csv --by triangle --nonzero");
  arguments->scene.add_to(command);
  const Option directions = command.option(
      "--directions", "FILE", arguments->directions,
      "CSV file with columns x, y and z: directions towards the sun or against the wind. Other "
      "columns are copied to the table");
  Option points = command.option("--points", "FILE", arguments->points,
                                 "CSV file with columns x, y and z: places of lamps");
  points.excludes(directions);
  arguments->camera.add_to(command);
  command.option("--by", "KIND", into(arguments->by, parse_area_item_kind),
                 "Measure each object (default), face, triangle, material, group, part or label");
  const auto parse_centroid = [](const std::string& text) {
    return parse_word<AreaCentroid>(text,
                                    {{"across", AreaCentroid::across}, {"lit", AreaCentroid::lit}});
  };
  command.option("--centroid", "WEIGHT", into(arguments->centroid, parse_centroid),
                 "Weigh centroids by the area across the direction (across, default) or on the "
                 "surface (lit)");
  add_cull_option(command, arguments->cull);
  command.flag("--nonzero", arguments->nonzero, "Leave out rows of which nothing is visible");
  command.flag("--json", arguments->json, "Write JSON instead of CSV");
  add_output_option(command, "FILE", arguments->output,
                    "Write the table to this file (default -, standard output)");
  command.runs([arguments](const Console& console) { return run_areas(*arguments, console); });
}

}  // namespace fathom::app
