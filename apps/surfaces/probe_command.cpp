// fathom probe SCENE… --camera FILE --pixel X,Y

#include <fmt/core.h>

#include <memory>

#include "apps/commands.h"
#include "apps/options/camera_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "apps/surfaces/probe_answer.h"
#include "fathom/failures/errors.h"
#include "fathom/threads/threads.h"

namespace fathom::app {
namespace {

struct ProbeArguments {
  SceneOptions scene;
  CameraOptions camera;
  std::array<std::uint32_t, 2> pixel{};
  Cull cull = Cull::none;
  bool json = false;
};

std::vector<CoveringTriangle> covering(const Scene& scene, const Camera& camera,
                                       const ProbeArguments& arguments, const Console& console) {
  const auto [x, y] = arguments.pixel;
  Progress progress(console, "probing");
  return with_threads(arguments.scene.threads, [&, x = x, y = y] {
    return probe(scene, camera, x, y, arguments.cull, progress.reporter());
  });
}

int run_probe(const ProbeArguments& arguments, const Console& console) {
  const auto [x, y] = arguments.pixel;
  const Scene scene = arguments.scene.read(console, {.segments = true});
  const Camera camera = arguments.camera.get_one(scene, arguments.scene.limits, "probe", console);
  if (x >= camera.width || y >= camera.height) {
    throw UsageError(fmt::format("--pixel: {},{} is outside the image of {}x{} pixels", x, y,
                                 camera.width, camera.height));
  }
  const Probe result{scene, camera, x, y, covering(scene, camera, arguments, console)};
  print(arguments.json ? as_json(result) : as_text(result));
  return done;
}

}  // namespace

void add_probe(Command& program) {
  const auto arguments = std::make_shared<ProbeArguments>();
  Command& command =
      program.command("probe", "Explain the value of one pixel",
                      "  fathom probe spot.obj --pixel 640,360\n"
                      "  fathom probe room.json --camera camera.json --pixel 12,34 --json");
  arguments->scene.add_to(command);
  arguments->camera.add_to(command);
  command
      .option("--pixel", "X,Y", into(arguments->pixel, parse_pixel),
              "Pixel X,Y: column and row from the top left")
      .required();
  add_cull_option(command, arguments->cull);
  command.flag("--json", arguments->json, "Print JSON");
  command.answers_on_standard_output();
  command.runs([arguments](const Console& console) { return run_probe(*arguments, console); });
}

}  // namespace fathom::app
