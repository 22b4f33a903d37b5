// fathom areas SCENE… --directions FILE | --points FILE | --camera FILE

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/options/camera_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "apps/surfaces/area_table.h"
#include "apps/surfaces/light_list.h"
#include "fathom/area/areas.h"
#include "fathom/failures/errors.h"
#include "fathom/threads/threads.h"

namespace fathom::app {
namespace {

struct AreasArguments {
  SceneOptions scene;
  CameraOptions camera;
  std::string directions, points;
  AreaItemKind by = AreaItemKind::object;
  std::optional<AreaCentroid> centroid;
  Cull cull = Cull::none;
  bool alone = false, nonzero = false, json = false, stream = false;
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
    try {
      return are_points ? areas_from_point(triangles, numbers, options)
                        : areas_in_direction(triangles, numbers, options);
    } catch (const UsageError& error) {  // the numbers are those of the file
      throw InputError(
          fmt::format("{}: line {}: {}", list.file, list.lights[light].line, error.what()));
    }
  }
};

bool has_light_file(const AreasArguments& a) {
  return !a.directions.empty() || !a.points.empty();
}

void expect_consistent(const AreasArguments& a, TableFormat format) {
  if (a.stream) {
    throw UsageError(
        "--stream: areas need the whole scene in memory, because any triangle may "
        "hide any other");
  }
  if (const auto given = a.camera.given(); given && has_light_file(a)) {
    throw UsageError(fmt::format("{} is for a camera, not for {}", *given,
                                 a.points.empty() ? "--directions" : "--points"));
  }
  if (a.centroid == AreaCentroid::across && a.directions.empty()) {
    throw UsageError(
        "--centroid across is for --directions; from a lamp or a camera, areas on the "
        "surface weigh the centroids");
  }
  if (a.alone && !a.points.empty()) {
    throw UsageError("--alone is for --directions and cameras; a lamp has no projected areas");
  }
  if (a.alone && a.by == AreaItemKind::triangle) {
    throw UsageError(
        "--alone is for groups of triangles; --by triangle has projected areas always");
  }
  if (a.nonzero && format == TableFormat::npz) {
    throw UsageError("--nonzero is for CSV and JSON; NPZ has every item in its arrays");
  }
}

Lights lights_of(const AreasArguments& a, const Scene& scene, const Console& console) {
  Lights lights;
  if (has_light_file(a)) {
    lights.are_points = a.directions.empty();
    lights.list = lights.are_points ? read_lights(a.points, LightList::Kind::points)
                                    : read_lights(a.directions, LightList::Kind::directions);
  } else {
    lights.cameras = a.camera.get(scene, a.scene.limits, console);
  }
  return lights;
}

AreaOptions options_of(const AreasArguments& a, const AreaItems& items, std::size_t lights) {
  AreaOptions options = fathom::options_of(items);
  options.cull = a.cull;
  options.centroid = a.centroid.value_or(AreaCentroid::across);
  options.alone = a.alone;
  options.threads = lights > 1 ? 1 : a.scene.threads;
  return options;
}

/// Measures several lights at the same time, each by one thread, makes their rows by
/// make(light, areas), and passes these on in the order of the lights. So many lights have rows in
/// memory:
constexpr std::size_t lights_at_once = 64;
template <class Make, class Take>
void measure(const Scene& scene, const Lights& lights, const AreasArguments& a,
             const AreaItems& items, const Console& console, const Make& make, const Take& take) {
  const AreaOptions options = options_of(a, items, lights.size());
  const TriangleSource triangles(scene);
  app::Progress shown(console, "measuring");
  const auto report = shown.reporter();
  fathom::Progress progress(report, lights.size());
  for (std::size_t first = 0; first < lights.size(); first += lights_at_once) {
    std::vector<std::invoke_result_t<Make, std::size_t, std::vector<LitArea>>> rows(
        std::min(lights_at_once, lights.size() - first));
    with_threads(a.scene.threads, [&] {
      in_parallel(rows.size(), [&](std::size_t k) {
        rows[k] = make(first + k, lights.areas(triangles, first + k, options));
        progress.part_done();
      });
    });
    for (const auto& some : rows) take(some);
  }
}

/// A command's scene and lights, and the items that it measures.
struct Question {
  const AreasArguments& arguments;
  const Console& console;
  const Scene& scene;
  const Lights& lights;
  const AreaItems& items;

  template <class Make, class Take>
  void answer(const Make& make, const Take& take) const {
    measure(scene, lights, arguments, items, console, make, take);
  }
};

/// Calls take(text) for the parts of the table.
template <class Take>
void write_text(const Question& q, TableFormat format, const Take& take) {
  const AreaTable table({format, q.arguments.by, q.arguments.nonzero}, q.items, q.lights.list);
  bool is_first = true;
  take(table.beginning());
  q.answer([&](std::size_t light, const auto& areas) { return table.rows(light, areas); },
           [&](const std::string& some) {
             take(table.after(some, is_first));
             is_first = is_first && some.empty();
           });
  take(table.end());
}

void write_arrays(const Question& q, int descriptor) {
  const AreaArrays arrays(q.arguments.by, q.items, q.lights.list, q.lights.size());
  NpzRows file(descriptor, q.arguments.output, arrays.arrays());
  arrays.append_others(file);
  q.answer([&](std::size_t, const auto& areas) { return arrays.rows(areas); },
           [&](const std::vector<files::Bytes>& rows) {
             for (std::size_t k = 0; k < rows.size(); ++k) file.append(k, rows[k]);
           });
  file.finish();
}

void write_file(const Question& q, TableFormat format, OutputFile& file) {
  file.write_by_descriptor([&](int descriptor) {
    if (format == TableFormat::npz) return write_arrays(q, descriptor);
    write_text(q, format, [&](std::string_view text) {
      write_all(descriptor, text.data(), text.size(), q.arguments.output);
    });
  });
  file.commit();
}

int run_areas(const AreasArguments& a, const Console& console) {
  const TableFormat format =
      about_option("--output", [&] { return table_format_of(a.output, a.json); });
  expect_consistent(a, format);
  const Scene scene = a.scene.read(console, {.segments = are_segments(a.by)});
  const Lights lights = lights_of(a, scene, console);
  TextOutput output(a.output);
  const AreaItems items = area_items(scene, a.by);
  if (items.items.empty()) {
    console.warn(fmt::format("the scene has no {}: the table has no rows", name_of(a.by)));
  }
  const Question question{a, console, scene, lights, items};
  if (OutputFile* const file = output.file()) {
    write_file(question, format, *file);
  } else {
    std::string all;
    write_text(question, format, [&](std::string_view text) { all += text; });
    output.finish(all);
  }
  return done;
}

}  // namespace

void add_areas(Command& program) {
  const auto arguments = std::make_shared<AreasArguments>();
  Command& command =
      program.command("areas", description_of_companion("areas"),
                      "  fathom areas house.obj --directions suns.csv --by face -o areas.csv\n"
                      "  fathom areas house.obj --directions suns.csv --alone -o areas.npz\n"
                      "  fathom areas room.json --points lamps.csv --by triangle --nonzero");
  arguments->scene.add_to(command);
  const Option directions = command.option(
      "--directions", "FILE", arguments->directions,
      "CSV file of directions towards the sun or against the wind: columns x, y and z, or azimuth "
      "(degrees clockwise from +y, the north; +x is the east) and elevation (degrees above the "
      "horizon; +z is up). Other columns are copied to the table");
  Option points = command.option("--points", "FILE", arguments->points,
                                 "CSV file with columns x, y and z: places of lamps");
  points.excludes(directions);
  arguments->camera.add_to(command);
  const auto parse_kind = [](const std::string& text) {
    return parse_enumerator(text, all_area_item_kinds);
  };
  command.option("--by", "KIND", into(arguments->by, parse_kind),
                 "Measure each object (default), face, triangle, material, group, part or label");
  const auto parse_centroid = [](const std::string& text) {
    return parse_word<AreaCentroid>(text,
                                    {{"across", AreaCentroid::across}, {"lit", AreaCentroid::lit}});
  };
  command.option("--centroid", "WEIGHT", into(arguments->centroid, parse_centroid),
                 "With --directions: weigh centroids by the area across the direction (across, "
                 "default) or on the surface (lit)");
  add_cull_option(command, arguments->cull);
  command.flag(
      "--alone", arguments->alone,
      "Also measure each item with everything else removed, for its projected area and its "
      "fraction");
  command.flag("--nonzero", arguments->nonzero, "Leave out items without a visible part");
  command.flag("--json", arguments->json, "Print JSON instead of CSV");
  command.flag("--stream", arguments->stream, "").below("");  // refused
  add_output_option(command, "FILE", arguments->output,
                    "Write the table to this file; the suffix chooses the format: .csv, "
                    ".npz or .json (default -, standard output)");
  command.runs([arguments](const Console& console) { return run_areas(*arguments, console); });
}

}  // namespace fathom::app
