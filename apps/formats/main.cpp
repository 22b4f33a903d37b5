// fathom-formats: what is read by others' libraries. The library starts it with --serve and talks
// to it over a socket; `fathom formats` says what it is built from.

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <string_view>

#include "apps/formats/tasks.h"
#include "apps/shell/failures.h"
#include "apps/shell/program.h"
#include "apps/shell/standard_streams.h"
#include "fathom/mesh_files/foreign_formats.h"
#include "fathom/mesh_files/formats_program/messages.h"

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

/// `fathom formats`: the libraries that read foreign formats, and the suffixes of their files.
void add_formats(Command& program) {
  Command& command = program.command(
      "formats", "Show which libraries read foreign mesh formats (FBX, COLLADA, 3DS, 3MF, …)",
      "  fathom formats\n"
      "  fathom info model.fbx");
  command.runs(show_formats);
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  using namespace fathom::mesh_files::formats_program;
  if (argc == 3 && argv[1] == serve) {
    if (argv[2] != message_version) return other_version;
    return fathom::app::serve_requests();
  }
  return fathom::app::companion_main(argc, argv, "formats", fathom::app::add_formats);
}
