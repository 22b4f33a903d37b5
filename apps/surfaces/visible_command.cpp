// fathom visible SCENE… --camera FILE

#include <fmt/core.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/options/camera_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/command.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "fathom/area/visible_areas.h"
#include "fathom/failures/errors.h"
#include "fathom/scene/triangle_source.h"
#include "fathom/text/counted.h"
#include "fathom/text/csv.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

struct VisibleArguments {
  SceneOptions scene;
  CameraOptions camera;
  Cull cull = Cull::none;
  std::string output = "-";
  bool json = false, csv = false;
};

/// What the answers are about.
struct Answer {
  const Scene& scene;
  const Camera& camera;
  const VisibleAreas& areas;
};

Json ratio_of(const VisibleArea& area) {
  return area.ratio ? Json(*area.ratio) : Json(nullptr);
}

std::string as_json(const Answer& answer) {
  Json objects = Json::array(), triangles = Json::array();
  for (std::size_t i = 0; i < answer.areas.objects.size(); ++i) {
    const VisibleArea& area = answer.areas.objects[i];
    objects.push_back({{"object", i},
                       {"name", answer.scene.objects[i].name},
                       {"visible", area.visible},
                       {"unoccluded", area.unoccluded},
                       {"ratio", ratio_of(area)}});
  }
  const TriangleSource source(answer.scene);
  for (std::size_t i = 0; i < answer.areas.triangles.size(); ++i) {
    const VisibleArea& area = answer.areas.triangles[i];
    const TriangleOrigin origin = source.origin(static_cast<std::uint32_t>(i));
    triangles.push_back({{"triangle", i},
                         {"object", origin.object},
                         {"face", origin.face},
                         {"visible", area.visible},
                         {"unoccluded", area.unoccluded},
                         {"ratio", ratio_of(area)}});
  }
  const Json json{{"width", answer.camera.width},
                  {"height", answer.camera.height},
                  {"objects", objects},
                  {"triangles", triangles}};
  return json_answer(json, 1);
}

std::string figures(const VisibleArea& area) {
  return fmt::format("{},{},{}", area.visible, area.unoccluded,
                     area.ratio ? fmt::format("{}", *area.ratio) : "");
}

std::string as_csv(const Answer& answer) {
  std::string text = "kind,number,object,name,face,visible,unoccluded,ratio\n";
  for (std::size_t i = 0; i < answer.areas.objects.size(); ++i) {
    text += fmt::format("object,{},{},{},,{}\n", i, i, text::csv_name(answer.scene.objects[i].name),
                        figures(answer.areas.objects[i]));
  }
  const TriangleSource source(answer.scene);
  for (std::size_t i = 0; i < answer.areas.triangles.size(); ++i) {
    const TriangleOrigin origin = source.origin(static_cast<std::uint32_t>(i));
    text += fmt::format("triangle,{},{},{},{},{}\n", i, origin.object,
                        text::csv_name(answer.scene.objects[origin.object].name), origin.face,
                        figures(answer.areas.triangles[i]));
  }
  return text;
}

std::string as_text(const Answer& answer) {
  std::string text =
      fmt::format("{}x{} pixels\n{:<32} {:>22} {:>22} {:>10}\n", answer.camera.width,
                  answer.camera.height, "object", "visible area", "unoccluded area", "ratio");
  for (std::size_t i = 0; i < answer.areas.objects.size(); ++i) {
    const VisibleArea& area = answer.areas.objects[i];
    text += fmt::format("{:<32} {:>22} {:>22} {:>10}\n",
                        text::printable(answer.scene.objects[i].name), area.visible,
                        area.unoccluded, area.ratio ? fmt::format("{:.6g}", *area.ratio) : "-");
  }
  std::size_t wholly = 0, partly = 0, hidden = 0, outside = 0;
  for (const VisibleArea& area : answer.areas.triangles) {
    ++(!area.ratio ? outside : area.visible == 0 ? hidden : *area.ratio == 1 ? wholly : partly);
  }
  text += fmt::format(
      "{}: {} visible, {} partly, {} hidden, {} outside the image, edge on or culled\n",
      text::counted(answer.areas.triangles.size(), "triangle"), wholly, partly, hidden, outside);
  return text;
}

int run_visible(const VisibleArguments& arguments, const Console& console) {
  if (arguments.json && arguments.csv) throw UsageError("--json and --csv exclude each other");
  RenderOptions options;
  options.cull = arguments.cull;
  options.threads = arguments.scene.threads;
  const Scene scene = arguments.scene.read(console);
  const Camera camera = arguments.camera.get_one(scene, arguments.scene.limits, "visible", console);
  TextOutput output(arguments.output);
  VisibleAreas areas;
  {
    Progress progress(console, "measuring");
    areas = visible_areas(scene, camera, options, progress.reporter());
  }
  const Answer answer{scene, camera, areas};
  output.finish(arguments.json  ? as_json(answer)
                : arguments.csv ? as_csv(answer)
                                : as_text(answer));
  return done;
}

}  // namespace

void add_visible(Command& program) {
  const auto arguments = std::make_shared<VisibleArguments>();
  Command& command =
      program.command("visible", description_of_companion("visible"),
                      "  fathom visible spot.obj\n"
                      "  fathom visible room.json --camera camera.json --json\n"
                      "  fathom visible room.json --camera camera.json --csv -o visible.csv");
  arguments->scene.add_to(command);
  arguments->camera.add_to(command);
  add_cull_option(command, arguments->cull);
  command.flag("--json", arguments->json,
               "Print every object and triangle as JSON, with areas in pixels and their ratio");
  command.flag("--csv", arguments->csv, "Print every object and triangle as CSV");
  add_output_option(command, "FILE", arguments->output,
                    "Write the result to this file (default -, standard output)");
  command.runs([arguments](const Console& console) { return run_visible(*arguments, console); });
}

}  // namespace fathom::app
