// fathom camera look-at

#include <memory>

#include "apps/camera/camera_command.h"
#include "apps/options/camera_options.h"
#include "apps/shell/command.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/values.h"
#include "fathom/camera/camera_files.h"

namespace fathom::app {
namespace {

struct LookAtArguments {
  Vector3 eye{}, target{}, up{0, 1, 0};
  LensChoice lens;
  std::string output = "-";
};

int run_look_at(const LookAtArguments& arguments) {
  const Camera camera = look_at(arguments.eye, arguments.target, arguments.up, arguments.lens);
  write_text(arguments.output, to_json(camera) + "\n");
  return done;
}

}  // namespace

void add_look_at(Command& camera) {
  const auto arguments = std::make_shared<LookAtArguments>();
  Command& command =
      camera.command("look-at", "Make a camera at a point, looking at another point",
                     "  fathom camera look-at --eye 2,1,3 --target 0,0,0 -o camera.json\n"
                     "  fathom camera look-at --eye 0,0,5 --orthographic 2 --size 512x512");
  command
      .option("--eye", "X,Y,Z", into(arguments->eye, parse_vector), "Position of the camera, X,Y,Z")
      .required();
  command.option("--target", "X,Y,Z", into(arguments->target, parse_vector),
                 "Point that the camera looks at, X,Y,Z (default 0,0,0)");
  add_up_option(command, arguments->up);
  add_lens_options(command, arguments->lens);
  add_output_option(command, "FILE", arguments->output,
                    "Write the camera file here (default: standard output)");
  command.runs([arguments](const Console&) { return run_look_at(*arguments); });
}

}  // namespace fathom::app
