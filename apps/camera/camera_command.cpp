// fathom camera look-at | orbit (| import …, camera_import_command.cpp)

#include <memory>

#include "apps/options/camera_options.h"
#include "apps/options/lens_options.h"
#include "apps/options/scene_options.h"
#include "apps/shell/numbers.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_making.h"
#include "fathom/numeric/errors.h"
#include "fathom/scene/framing.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {
namespace {

struct LookAtArguments {
  std::string eye, target = "0,0,0", up = "0,1,0", output = "-";
  LensOptions lens;
};

int run_look_at(const LookAtArguments& arguments) {
  const Camera camera =
      look_at(parse_vector("--eye", arguments.eye), parse_vector("--target", arguments.target),
              parse_vector("--up", arguments.up), arguments.lens.get());
  write_text(arguments.output, to_json(camera) + "\n");
  return done;
}

void add_look_at(Program& program, CLI::App& parent) {
  const auto arguments = std::make_shared<LookAtArguments>();
  CLI::App* command =
      program.add_command("look-at", "The camera at a point that looks at another",
                          "  fathom camera look-at --eye 2,1,3 --target 0,0,0 -o camera.json\n"
                          "  fathom camera look-at --eye 0,0,5 --orthographic 2 --size 512x512",
                          &parent);
  command->add_option("--eye", arguments->eye, "X,Y,Z of the camera")->required();
  command->add_option("--target", arguments->target, "X,Y,Z it looks at (default 0,0,0)");
  command->add_option("--up", arguments->up, "X,Y,Z: upwards in the image (default 0,1,0)");
  arguments->lens.add_to(*command);
  command->add_option("-o,--output", arguments->output, "Camera file (default: standard output)");
  command->callback(
      [arguments, &program] { program.run = [arguments] { return run_look_at(*arguments); }; });
}

struct OrbitArguments {
  std::vector<std::string> scene;
  std::string views, centre, distance, output = "-";
  ViewOptions first;
  LensOptions lens;
};

std::vector<Camera> orbit_cameras(const OrbitArguments& arguments, const Console& console) {
  const View first = arguments.first.get();
  const std::uint32_t count = parse_count("--views", arguments.views, 1);
  const Lens lens = arguments.lens.get();
  if (arguments.scene.empty()) {
    if (arguments.distance.empty()) throw UsageError("orbit needs a SCENE to frame, or --distance");
    const Vector3 centre =
        parse_vector("--centre", arguments.centre.empty() ? "0,0,0" : arguments.centre);
    return orbit(first, count, centre, parse_number("--distance", arguments.distance), lens);
  }
  if (!arguments.distance.empty() || !arguments.centre.empty()) {
    throw UsageError("--centre and --distance do not go with a SCENE, which decides them");
  }
  SceneOptions scene;
  scene.files = arguments.scene;
  const std::optional<WorldBounds> bounds = world_bounds(scene.read(console, false));
  if (!bounds) throw InputError(arguments.scene[0] + ": no triangle; expected something to frame");
  return orbit(first, count, *bounds, lens);
}

int run_orbit(const OrbitArguments& arguments, const Console& console) {
  write_text(arguments.output, to_json(orbit_cameras(arguments, console)) + "\n");
  return done;
}

void add_orbit(Program& program, CLI::App& parent) {
  const auto arguments = std::make_shared<OrbitArguments>();
  CLI::App* command = program.add_command(
      "orbit", "A camera path around a scene or a point",
      "  fathom camera orbit data/meshes/spot.obj --views 12 -o path.json\n"
      "  fathom render data/meshes/spot.obj --camera path.json -o 'maps/{index:04}.exr'\n"
      "  fathom camera orbit --views 36 --centre 0,0,1 --distance 4 --view 0,30 --up z",
      &parent);
  command->add_option("SCENE", arguments->scene, "Meshes and scene files to frame");
  command->add_option("--views", arguments->views, "How many")->required();
  arguments->first.add_to(*command);
  command->add_option("--centre", arguments->centre, "X,Y,Z of what is looked at (default 0,0,0)");
  command->add_option("--distance", arguments->distance, "Of the eye from the centre");
  arguments->lens.add_to(*command);
  command->add_option("-o,--output", arguments->output, "Camera file (default: standard output)");
  command->callback([arguments, &program] {
    program.run = [arguments, &program] { return run_orbit(*arguments, program.console); };
  });
}

}  // namespace

void add_camera(Program& program) {
  CLI::App* command = program.add_command(
      "camera", "Make a camera file",
      "  fathom camera look-at --eye 2,1,3 --target 0,0,0 -o camera.json\n"
      "  fathom camera orbit data/meshes/spot.obj --views 12 -o path.json\n"
      "  fathom camera import colmap sparse/0 -o cameras.json\n"
      "\nWhat is written is rounded to binary64 and from then on is the truth.");
  command->require_subcommand(1);
  add_look_at(program, *command);
  add_orbit(program, *command);
  add_camera_import(program, *command);
}

}  // namespace fathom::app
