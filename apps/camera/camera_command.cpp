#include "apps/camera/camera_command.h"

namespace fathom::app {

void add_camera(Command& program) {
  Command& family = program.command(
      "camera", "Make a camera file",
      "  fathom camera look-at --eye 2,1,3 --target 0,0,0 -o camera.json\n"
      "  fathom camera orbit data/meshes/spot.obj --views 12 -o path.json\n"
      "  fathom camera import colmap sparse/0 -o cameras.json\n"
      "\nNumbers are rounded to binary64 when they are written; what is written is the camera.\n"
      "docs/camera-files.md has the keys of camera files.");
  family.requires_command();
  add_look_at(family);
  add_orbit(family);
  add_import(family);
}

}  // namespace fathom::app
