#include "apps/camera/shutter_command.h"
#include "apps/commands.h"
#include "apps/options/camera_options.h"
#include "apps/rays/ray_file.h"
#include "apps/shell/output_file.h"
#include "fathom/camera/trajectory.h"
#include "fathom/rays/shutter_rays.h"

namespace fathom::app {
namespace {

int write_shutter_rays(const ShutterArguments& arguments, const Console& console) {
  const Camera camera = read_camera_with_lens(arguments.camera, arguments.limits, console);
  const Trajectory path = Trajectory::read(arguments.poses);
  OutputFile output(arguments.output);
  const RollingShutter shutter{arguments.start.value_or(path.first_time()), arguments.readout};
  output.write(npy_of_rays(shutter_rays(camera, path, shutter)));
  output.commit();
  return done;
}

}  // namespace

void add_camera_shutter(Command& program) {
  Command& family = program.command("camera", "Write the rays of a camera", "");
  family.requires_command();
  add_shutter(family, write_shutter_rays);
}

}  // namespace fathom::app
