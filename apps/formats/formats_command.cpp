// fathom formats

#include "apps/formats/formats_command.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "apps/formats/tasks.h"
#include "apps/shell/failures.h"
#include "apps/shell/standard_streams.h"
#include "fathom/mesh_files/foreign_formats.h"

namespace fathom::app {
namespace {

int show_formats(const Console&) {
  print(
      fmt::format("{}: {}\n{}: glTF with KHR_draco_mesh_compression\n"
                  "{}: glTF with EXT_meshopt_compression or KHR_meshopt_compression\n",
                  assimp_version(), fmt::join(mesh_files::foreign_suffixes, " "), draco_version(),
                  meshoptimizer_version()));
  return done;
}

}  // namespace

void add_formats(Command& program) {
  Command& command = program.command(
      "formats", "Show which libraries read foreign mesh formats (FBX, COLLADA, 3DS, 3MF, …)",
      "  fathom formats\n"
      "  fathom info model.fbx");
  command.runs(show_formats);
}

}  // namespace fathom::app
