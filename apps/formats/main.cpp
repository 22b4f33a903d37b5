// fathom-formats: what is read by others' libraries. The library starts it with --serve and talks
// to it over a socket; `fathom formats` says what it is built from.

#include <string_view>

#include "apps/formats/formats_command.h"
#include "apps/formats/service.h"
#include "apps/shell/program.h"
#include "fathom/mesh_files/formats_program/messages.h"

int main(int argc, char** argv) {
  using namespace fathom::mesh_files::formats_program;
  if (argc == 3 && argv[1] == serve) {
    if (argv[2] != message_version) return other_version;
    return fathom::app::serve_requests();
  }
  return fathom::app::companion_main(argc, argv, "formats", fathom::app::add_formats);
}
