// fathom, the everyday program. What takes long to compile or needs other packages is a program of
// its own, which this one starts.

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/dataset/dataset_command.h"
#include "apps/render/render_command.h"
#include "apps/shell/program.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

std::vector<Companion> companions() {
  return {companion_table.begin(), companion_table.end()};
}

/// `render --engine pipeline` is carried out by fathom-textbook, which gets the same arguments.
Render by_textbook(const std::vector<std::string>& arguments) {
  return [arguments](const RenderArguments&, const Console&) -> int {
    start_companion("fathom-textbook", arguments);
    throw UsageError(
        not_built("'--engine pipeline'", "fathom-textbook", "render … --engine pipeline"));
  };
}

/// `camera shutter` is carried out by fathom-surfaces, which has rays.
ShutterRun by_surfaces(const std::vector<std::string>& arguments) {
  return [arguments](const ShutterArguments&, const Console&) -> int {
    start_companion("fathom-surfaces", arguments);
    throw UsageError(not_built("'camera shutter'", "fathom-surfaces", "camera shutter"));
  };
}

std::vector<AddCommand> commands(const std::vector<std::string>& arguments) {
  const auto add_render_command = [arguments](Command& program) {
    add_render(program, render_exactly, by_textbook(arguments));
  };
  const auto add_camera_command = [arguments](Command& program) {
    add_camera(program, by_surfaces(arguments));
  };
  return {add_render_command, add_probe,          add_info,    add_preview, add_compare,
          add_convert,        add_camera_command, add_dataset, add_depth};
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  return fathom::app::program_main(argc, argv, fathom::app::commands, fathom::app::companions);
}
