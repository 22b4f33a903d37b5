// fathom pipeline trace SCENE…, fathom pipeline run STAGE [FILE]

#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/options/camera_options.h"
#include "apps/options/depth_format_options.h"
#include "apps/options/pipeline_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "apps/textbook/cases/json_lines.h"
#include "apps/textbook/drawing/drawings.h"
#include "apps/textbook/pipeline/pipeline_report.h"
#include "apps/textbook/pipeline/stage_cases.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

struct TraceArguments {
  SceneOptions scene;
  CameraOptions camera;
  PipelineArguments pipeline;
  DepthFormat depth_format = pipeline::PipelineOptions().depth_format;
  std::optional<std::uint32_t> triangle, primitive;
  std::optional<pipeline::Pixel> pixel;
  Cull cull = Cull::none;
  bool fragments = false, json = false;
  std::string draw;
};

void add_depth_format(Command& command, DepthFormat& format, const std::string& heading) {
  command
      .option("--depth-format", "NAME", into(format.storage, storage_named),
              "Storage of the z-buffer: " + list_of_storages())
      .below(heading);
  command
      .option("--mapping", "NAME", into(format.mapping, mapping_named),
              "Mapping of the z-buffer: " + list_of_mappings())
      .below(heading);
  command
      .option("--c", "C", into(format.c, parse_number), "Constant C of --mapping log (default 1)")
      .below(heading);
}

pipeline::PrimitiveTrace traced(const TraceArguments& arguments, const Scene& scene,
                                const Camera& camera, const pipeline::PipelineOptions& stages) {
  const auto triangles = static_cast<std::uint32_t>(triangle_count(scene));
  const std::uint32_t number = arguments.primitive.value_or(arguments.triangle.value_or(0));
  if (arguments.triangle && number >= triangles)
    throw UsageError(
        fmt::format("--triangle: there is no triangle {}; the scene has {}", number, triangles));
  return pipeline::trace_primitive(
      scene, camera, stages, number,
      {.pixel = arguments.pixel,
       .fragments = arguments.fragments,
       .merger = arguments.pixel.has_value(),
       .painter = stages.hidden_surface == pipeline::HiddenSurface::painter});
}

int run_trace(const TraceArguments& arguments, const Console& console) {
  if (arguments.triangle && arguments.primitive)
    throw UsageError("--triangle and --primitive exclude each other");
  pipeline::PipelineOptions stages = arguments.pipeline.options(arguments.cull);
  stages.depth_format = arguments.depth_format;
  pipeline::require_meaningful(stages);
  const Scene scene = arguments.scene.read(console, {.attributes = true, .primitives = true});
  const Camera camera = arguments.camera.get_one(scene, arguments.scene.limits, "trace", console);
  const auto& pixel = arguments.pixel;
  if (pixel && (pixel->x >= camera.width || pixel->y >= camera.height)) {
    throw UsageError(fmt::format("--pixel: {},{} is outside the image of {}x{} pixels", pixel->x,
                                 pixel->y, camera.width, camera.height));
  }
  warn_of_windows(camera, stages, console);
  cases::StepsPicture picture(arguments.draw);
  const pipeline::PrimitiveTrace trace = traced(arguments, scene, camera, stages);
  if (picture.is_wanted())
    for (auto& each : drawing::draw_trace(to_json(trace), camera.width, camera.height))
      picture.add(std::move(each));
  picture.finish("fathom pipeline trace");
  print(arguments.json ? json_answer(to_json(trace)) : as_text(trace));
  return done;
}

void add_trace(Command& family) {
  const auto arguments = std::make_shared<TraceArguments>();
  Command& command = family.command(
      "trace", "Follow a triangle, a line or a point through the stages of the pipeline",
      "  fathom pipeline trace spot.obj --triangle 238 --pixel 640,360\n"
      "  fathom pipeline trace spot.obj --triangle 238 --fragments\n"
      "  fathom pipeline trace cube.obj --triangle 3 --precision binary64 --json");
  arguments->scene.add_to(command);
  arguments->camera.add_to(command);
  command.option("--triangle", "N", into(arguments->triangle, parse_count),
                 "Number of the triangle in the scene (default 0)");
  command.option("--primitive", "N", into(arguments->primitive, parse_count),
                 "Number of a primitive, as in channel id: triangles first, then the lines and "
                 "points of each object");
  command.option(
      "--pixel", "X,Y",
      [&pixel = arguments->pixel](const std::string& text) {
        const auto [x, y] = parse_pixel(text);
        pixel = pipeline::Pixel{x, y};
      },
      "Show the sample at the centre of this pixel, and every step of the output merger there");
  command.flag("--fragments", arguments->fragments,
               "List the fragments: pixel, window depth, depth, stored depth, colour");
  command.flag("--json", arguments->json, "Print JSON");
  command.option("--draw", "SVG", into(arguments->draw, cases::parse_svg_name),
                 "Draw the primitive in the window, listed fragments, the output merger at the "
                 "pixel, and the painter's order with its splits");
  command.option(
      "--background", "R,G,B",
      [&pipeline = arguments->pipeline](const std::string& text) {
        pipeline.set_background(parse_colour(text));
      },
      "Colour of the pixel before anything is drawn, 0 to 1 (default 0,0,0)");
  add_cull_option(command, arguments->cull);
  arguments->pipeline.add_to_trace(command, "Pipeline");
  add_depth_format(command, arguments->depth_format, "Pipeline");
  command.answers_on_standard_output();
  command.runs([arguments](const Console& console) { return run_trace(*arguments, console); });
}

struct RunArguments {
  std::string stage;
  pipeline::Precision precision = pipeline::Precision::binary32;
  std::string file = "-";
};

std::string parse_stage(const std::string& text) {
  std::vector<std::string> names;
  for (const StageDescription& stage : pipeline_stages()) names.push_back(stage.name);
  if (std::ranges::count(names, text) == 0) refuse_word(text, names);
  return text;
}

std::string names_of_stages() {
  std::string list;
  for (const StageDescription& stage : pipeline_stages())
    list += (list.empty() ? "" : ", ") + stage.name;
  return list;
}

void add_run(Command& family) {
  const auto arguments = std::make_shared<RunArguments>();
  Command& command = family.command(
      "run", "Run one stage of the pipeline by itself, on records given as JSON lines",
      "  echo '{\"clip\": [[0,0,-3,-1],[1,0,1,2],[0,1,1,2]], \"mapping\": \"opengl\"}' |\n"
      "    fathom pipeline run clipping\n"
      "  echo '{\"ndc\": [[0,0,0.5],[1,0,0.5],[0,1,0.5]], \"width\": 8, \"height\": 8}' |\n"
      "    fathom pipeline run viewport | fathom pipeline run scan-conversion |\n"
      "    fathom pipeline run output-merger\n"
      "\n"
      "The output record contains the results of the stage and can be passed to the next stage. "
      "Keys of each stage: pipeline.md in the documentation.");
  command
      .argument("STAGE", into(arguments->stage, parse_stage),
                "Name of the stage, in the order of the data: " + names_of_stages())
      .required();
  command.argument("FILE", arguments->file,
                   "File with one record per line (default and -: standard input)");
  command.option("--precision", "NAME", into(arguments->precision, parse_precision),
                 "Arithmetic of the stage: binary32 (default) or binary64");
  command.answers_on_standard_output();
  command.runs([arguments](const Console&) {
    return cases::answer_lines(arguments->file, [&](const cases::Json& record) {
      cases::Json answer = run_stage(arguments->stage, record, arguments->precision);
      answer.erase("name");  // answer_lines() puts it in front
      return answer;
    });
  });
}

}  // namespace

void add_pipeline(Command& program) {
  Command& family = program.command("pipeline", description_of_companion("pipeline"),
                                    "  fathom pipeline trace spot.obj --triangle 238\n"
                                    "  fathom pipeline run viewport records.jsonl");
  family.requires_command();
  add_trace(family);
  add_run(family);
}

}  // namespace fathom::app
