#include "apps/camera/camera_command.h"

namespace fathom::app {

void add_camera(Command& program) {
  Command& family =
      program.command("camera", "Make or import a camera file",
                      "  fathom camera look-at --eye 2,1,3 --target 0,0,0 -o camera.json\n"
                      "  fathom camera orbit spot.obj --views 12 -o path.json\n"
                      "  fathom camera import colmap sparse/0 -o cameras.json\n"
                      "\nNumbers are rounded to binary64 when they are written; the written "
                      "numbers define the camera.\n"
                      "Keys of camera files: camera-files.md in the documentation.");
  family.requires_command();
  add_look_at(family);
  add_orbit(family);
  add_import(family);
}

}  // namespace fathom::app
