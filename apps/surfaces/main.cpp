// fathom-surfaces: areas, drawings, rays and sight, which a map does not need.

#include "apps/commands.h"
#include "apps/shell/program.h"

namespace fathom::app {
namespace {

std::vector<AddCommand> commands(const std::vector<std::string>&) {
  return {add_visible,  add_areas, add_sun,  add_draw,   add_evaluate,
          add_coplanar, add_cast,  add_sees, add_doctor, add_camera_shutter};
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  return fathom::app::program_main(argc, argv, fathom::app::commands);
}
