// fathom camera import colmap | nerf | bop | opengl

#include <fmt/format.h>

#include <functional>
#include <memory>

#include "apps/shell/numbers.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_import.h"
#include "fathom/numeric/errors.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {
namespace {

struct ImportArguments {
  std::string input, size, image, output = "-";
  bool list = false;
};

std::array<std::uint32_t, 2> size_of(const ImportArguments& arguments) {
  if (arguments.size.empty()) return {0, 0};
  return parse_size("--size", arguments.size);
}

/// All cameras as a path, or the one of an image, or the list of names.
int write_imported(const std::vector<ImportedCamera>& imported, const ImportArguments& arguments) {
  if (arguments.list) {
    std::string text;
    for (const ImportedCamera& entry : imported) text += entry.name + "\n";
    write_text(arguments.output, text);
    return done;
  }
  std::vector<Camera> cameras;
  for (const ImportedCamera& entry : imported) {
    if (arguments.image.empty() || entry.name == arguments.image) cameras.push_back(entry.camera);
  }
  if (cameras.empty()) {
    throw InputError(arguments.image.empty()
                         ? arguments.input + ": holds no camera"
                         : fmt::format("{}: no image '{}'; --list shows the {} there are",
                                       arguments.input, arguments.image, imported.size()));
  }
  write_text(arguments.output, to_json(cameras) + "\n");
  return done;
}

using Importer = std::function<std::vector<ImportedCamera>(const ImportArguments&, const Console&)>;

void add_importer(Program& program, CLI::App& parent, const std::string& name,
                  const std::string& description, const std::string& input, bool takes_size,
                  const std::string& example, const Importer& read) {
  const auto arguments = std::make_shared<ImportArguments>();
  CLI::App* command = program.add_command(name, description, example, &parent);
  command->add_option("INPUT", arguments->input, input)->required();
  if (takes_size) {
    command->add_option("--size", arguments->size, "WIDTHxHEIGHT of the images in pixels");
  }
  command->add_option("--image", arguments->image, "Only the camera of this image");
  command->add_flag("--list", arguments->list, "Write the names of the images instead");
  command->add_option("-o,--output", arguments->output, "Camera file (default: standard output)");
  command->callback([arguments, read, &program] {
    program.run = [arguments, read, &program] {
      return write_imported(read(*arguments, program.console), *arguments);
    };
  });
}

}  // namespace

void add_camera_import(Program& program, CLI::App& camera) {
  CLI::App* command = program.add_command(
      "import", "Convert the cameras of other programs",
      "  fathom camera import colmap sparse/0 -o cameras.json\n"
      "  fathom camera import nerf transforms.json --size 800x800 -o cameras.json\n"
      "\nA camera with lens distortion is refused; docs/conventions.md has the formulas.",
      &camera);
  command->require_subcommand(1);
  add_importer(program, *command, "colmap", "COLMAP: cameras and images, .bin or .txt",
               "The folder of the model", false,
               "  fathom camera import colmap sparse/0 --image IMG_0001.jpg -o camera.json",
               [](const ImportArguments& a, const Console&) { return import_colmap(a.input); });
  add_importer(program, *command, "nerf", "NeRF, Nerfstudio, instant-ngp: transforms.json",
               "transforms.json", true,
               "  fathom camera import nerf transforms.json --size 800x800 -o cameras.json",
               [](const ImportArguments& a, const Console& console) {
                 const auto [width, height] = size_of(a);
                 Warnings warnings;
                 auto cameras = import_nerf(a.input, width, height, warnings);
                 console.warn(warnings);
                 return cameras;
               });
  add_importer(program, *command, "bop", "BOP: scene_camera.json", "scene_camera.json", true,
               "  fathom camera import bop scene_camera.json --size 640x480 -o cameras.json",
               [](const ImportArguments& a, const Console&) {
                 if (a.size.empty())
                   throw UsageError("bop needs --size: the file does not have it");
                 const auto [width, height] = size_of(a);
                 return import_bop(a.input, width, height);
               });
  add_importer(program, *command, "opengl", "OpenGL: projection, modelview and viewport as JSON",
               "A JSON file with projection, modelview and viewport", false,
               "  fathom camera import opengl matrices.json -o camera.json",
               [](const ImportArguments& a, const Console&) { return import_opengl(a.input); });
}

}  // namespace fathom::app
