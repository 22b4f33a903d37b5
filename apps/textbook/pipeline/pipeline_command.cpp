// fathom pipeline trace SCENE…

#include <fmt/core.h>

#include <memory>

#include "apps/options/camera_options.h"
#include "apps/options/cull_option.h"
#include "apps/options/pipeline_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/exit_status.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "apps/textbook/pipeline/trace_report.h"
#include "apps/textbook/textbook_commands.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

struct TraceArguments {
  SceneOptions scene;
  CameraOptions camera;
  PipelineArguments pipeline;
  DepthFormat depth_format = pipeline::PipelineOptions().depth_format;
  std::uint32_t triangle = 0;
  std::optional<pipeline::Pixel> pixel;
  Cull cull = Cull::none;
  bool json = false;
};

void add_depth_format(Command& command, DepthFormat& format, const std::string& heading) {
  command
      .option("--depth-format", "NAME", into(format.storage, storage_named),
              "Of the z-buffer: unorm16, unorm24, unorm32, float16, float32 (default) or float64")
      .below(heading);
  command
      .option("--mapping", "NAME", into(format.mapping, mapping_named),
              "Of the z-buffer: standard (default), reversed, infinite, reversed-infinite, opengl, "
              "linear, w, log or log-ulrich")
      .below(heading);
  command
      .option("--c", "C", into(format.c, parse_number),
              "With --mapping log: the constant C (default 1)")
      .below(heading);
}

int run_trace(const TraceArguments& arguments, const Console& console) {
  pipeline::PipelineOptions stages = arguments.pipeline.options(arguments.cull);
  stages.depth_format = arguments.depth_format;
  pipeline::require_meaningful(stages);
  if (stages.shading == pipeline::Shading::points || stages.shading == pipeline::Shading::wireframe)
    throw UsageError("--shading: points and wireframe draw no triangle that could be traced");
  const Scene scene = arguments.scene.read(console, {.attributes = true});
  const Camera camera = arguments.camera.get_one(scene, "trace", console);
  const auto& pixel = arguments.pixel;
  if (pixel && (pixel->x >= camera.width || pixel->y >= camera.height)) {
    throw UsageError(fmt::format("--pixel: {},{} is outside the image of {}x{} pixels", pixel->x,
                                 pixel->y, camera.width, camera.height));
  }
  const pipeline::TriangleTrace trace =
      pipeline::trace_triangle(scene, camera, stages, arguments.triangle, pixel);
  print(arguments.json ? as_json(trace) : as_text(trace));
  return done;
}

void add_trace(Command& family) {
  const auto arguments = std::make_shared<TraceArguments>();
  Command& command =
      family.command("trace", "Follow a triangle through the stages of the pipeline",
                     "  fathom pipeline trace data/meshes/spot.obj --triangle 238 --pixel 640,360\n"
                     "  fathom pipeline trace cube.obj --triangle 3 --precision binary64 --json");
  arguments->scene.add_to(command);
  arguments->camera.add_to(command);
  command.option("--triangle", "N", into(arguments->triangle, parse_count),
                 "Its number in the scene (default 0)");
  command.option(
      "--pixel", "X,Y",
      [&pixel = arguments->pixel](const std::string& text) {
        const auto [x, y] = parse_pixel(text);
        pixel = pipeline::Pixel{x, y};
      },
      "X,Y: also what becomes of the sample at this pixel's centre");
  command.flag("--json", arguments->json, "Answer in JSON");
  add_cull_option(command, arguments->cull);
  arguments->pipeline.add_to_trace(command, "Pipeline");
  add_depth_format(command, arguments->depth_format, "Pipeline");
  command.answers_on_standard_output();
  command.runs([arguments](const Console& console) { return run_trace(*arguments, console); });
}

}  // namespace

void add_pipeline(Command& program) {
  Command& family = program.command("pipeline", "Look into the graphics pipeline",
                                    "  fathom pipeline trace spot.obj --triangle 238");
  family.requires_command();
  add_trace(family);
}

}  // namespace fathom::app
