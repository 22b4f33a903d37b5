// fathom areas SCENE… --directions FILE | --points FILE | --camera FILE

#include <fcntl.h>
#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>

#include "apps/commands.h"
#include "apps/options/camera_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "apps/surfaces/area_items.h"
#include "apps/surfaces/area_table.h"
#include "apps/surfaces/light_list.h"
#include "fathom/area/areas.h"
#include "fathom/failures/errors.h"
#include "fathom/files/descriptor.h"
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
  bool nonzero = false, json = false, stream = false;
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

void expect_consistent(const AreasArguments& a) {
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

/// Takes the parts of a text, one after the other.
using TakePart = std::function<void(std::string_view)>;

/// Measures several lights at the same time, each by one thread, and passes on their rows in the
/// order of the lights. So many lights have rows in memory:
constexpr std::size_t lights_at_once = 64;
void measure(const Scene& scene, const Lights& lights, const AreasArguments& a,
             const AreaItems& items, const AreaTable& table, const Console& console,
             const TakePart& take) {
  AreaOptions options;
  options.cull = a.cull;
  options.centroid = a.centroid.value_or(AreaCentroid::across);
  options.threads = lights.size() > 1 ? 1 : a.scene.threads;
  options.groups = items.of_triangle;
  options.group_count = static_cast<std::uint32_t>(items.items.size());
  const TriangleSource triangles(scene);
  app::Progress shown(console, "measuring");
  const auto report = shown.reporter();
  fathom::Progress progress(report, lights.size());
  bool is_first = true;
  take(table.beginning());
  for (std::size_t first = 0; first < lights.size(); first += lights_at_once) {
    std::vector<std::string> rows(std::min(lights_at_once, lights.size() - first));
    with_threads(a.scene.threads, [&] {
      in_parallel(rows.size(), [&](std::size_t k) {
        rows[k] = table.rows(first + k, lights.areas(triangles, first + k, options));
        progress.part_done();
      });
    });
    for (const std::string& some : rows) {
      take(table.after(some, is_first));
      is_first = is_first && some.empty();
    }
  }
  take(table.end());
}

int run_areas(const AreasArguments& a, const Console& console) {
  expect_consistent(a);
  const TableFormat format =
      about_option("--output", [&] { return table_format_of(a.output, a.json); });
  const bool has_segments = a.by == AreaItemKind::material || a.by == AreaItemKind::group ||
                            a.by == AreaItemKind::part || a.by == AreaItemKind::label;
  const Scene scene = a.scene.read(console, {.segments = has_segments});
  const Lights lights = lights_of(a, scene, console);
  TextOutput output(a.output);
  const AreaItems items = area_items(scene, a.by);
  const AreaTable table({format, a.by, a.nonzero}, items, lights.list);
  if (OutputFile* const file = output.file()) {
    file->write([&](const std::filesystem::path& staged) {
      const files::Descriptor open(::open(staged.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
      if (!open.is_open()) fail_with_errno(a.output, errno);
      measure(scene, lights, a, items, table, console, [&](std::string_view text) {
        write_all(open.get(), text.data(), text.size(), a.output);
      });
    });
    file->commit();
  } else {
    std::string all;
    measure(scene, lights, a, items, table, console, [&](std::string_view text) { all += text; });
    output.finish(all);
  }
  return done;
}

}  // namespace

void add_areas(Command& program) {
  const auto arguments = std::make_shared<AreasArguments>();
  Command& command = program.command(
      "areas", "Measure the areas that a sun, a lamp or a camera sees, exactly, without pixels",
      "  fathom areas house.obj --directions suns.csv --by face -o areas.csv\n"
      "  fathom areas house.obj --directions suns.csv --centroid lit -o areas.json\n"
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
  command.option("--by", "KIND", into(arguments->by, parse_area_item_kind),
                 "Measure each object (default), face, triangle, material, group, part or label");
  const auto parse_centroid = [](const std::string& text) {
    return parse_word<AreaCentroid>(text,
                                    {{"across", AreaCentroid::across}, {"lit", AreaCentroid::lit}});
  };
  command.option("--centroid", "WEIGHT", into(arguments->centroid, parse_centroid),
                 "With --directions: weigh centroids by the area across the direction (across, "
                 "default) or on the surface (lit)");
  add_cull_option(command, arguments->cull);
  command.flag("--nonzero", arguments->nonzero, "Leave out items without a visible part");
  command.flag("--json", arguments->json, "Print JSON instead of CSV");
  command.flag("--stream", arguments->stream, "").below("");  // refused
  add_output_option(command, "FILE", arguments->output,
                    "Write the table to this file; the suffix chooses the format: .csv or .json "
                    "(default -, standard output)");
  command.runs([arguments](const Console& console) { return run_areas(*arguments, console); });
}

}  // namespace fathom::app
