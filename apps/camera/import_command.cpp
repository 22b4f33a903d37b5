// fathom camera import …: what all kinds of files have in common

#include <fmt/core.h>

#include <memory>

#include "apps/camera/import_sources.h"
#include "apps/shell/command.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "fathom/camera/camera_files.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

/// All cameras as a path, or the one of an image, or the list of names.
int write_imported(const std::vector<ImportedCamera>& imported, const ImportArguments& arguments,
                   const Console& console) {
  if (arguments.list) {
    std::string text;
    for (const ImportedCamera& entry : imported) text += text::printable(entry.camera.name) + "\n";
    write_text(arguments.output, text);
    return done;
  }
  Warnings warnings;
  const std::vector<Camera> cameras =
      chosen_cameras(imported, arguments.input, arguments.choice, warnings);
  console.warn(warnings);
  write_text(arguments.output, to_json(cameras) + "\n");
  return done;
}

void add_source(Command& parent, const ImportSource& source) {
  const auto arguments = std::make_shared<ImportArguments>();
  Command& command = parent.command(source.name, source.description, source.example);
  command.argument("INPUT", arguments->input, source.input).required();
  source.declare(command, *arguments);
  command.option("--image", "NAME", arguments->choice.image,
                 "Import only the camera of this image");
  add_distortion_option(command, arguments->choice);
  command.flag("--list", arguments->list, "Print the names of the images instead");
  add_output_option(command, "FILE", arguments->output,
                    "Write the camera file here (default: standard output)");
  command.runs([arguments, read = source.read](const Console& console) {
    Warnings warnings;
    const std::vector<ImportedCamera> imported = read(*arguments, warnings);
    console.warn(warnings);
    return write_imported(imported, *arguments, console);
  });
}

}  // namespace

void add_import(Command& camera) {
  Command& family =
      camera.command("import", "Import the cameras of other programs and of data sets",
                     "  fathom camera import colmap sparse/0 -o cameras.json\n"
                     "  fathom camera import nerf transforms.json --size 800x800 -o cameras.json\n"
                     "  fathom camera import tum groundtruth.txt --images depth.txt --K ros \\\n"
                     "    -o cameras.json\n"
                     "\nLenses are imported with the cameras; lenses without a model are left "
                     "out with a warning.\n"
                     "Models: lenses.md, formulas and layouts: conventions.md and data-sets.md in "
                     "the documentation.\n"
                     "Each camera has the name of its image: render -o 'maps/{stem}.exr' writes "
                     "maps of the same names.");
  family.requires_command();
  for (const ImportSource& source : program_sources()) add_source(family, source);
  for (const ImportSource& source : calibration_sources()) add_source(family, source);
  for (const ImportSource& source : data_set_sources()) add_source(family, source);
}

}  // namespace fathom::app
