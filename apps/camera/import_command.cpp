// fathom camera import colmap | nerf | bop | opengl

#include <fmt/core.h>

#include <functional>
#include <memory>
#include <optional>

#include "apps/camera/camera_command.h"
#include "apps/shell/exit_status.h"
#include "apps/shell/text_output.h"
#include "apps/shell/values.h"
#include "fathom/camera/camera_files.h"
#include "fathom/camera/camera_import.h"
#include "fathom/numeric/errors.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

struct ImportArguments {
  std::string input, output = "-";
  CameraChoice choice;
  std::optional<Size> size;
  bool list = false;
};

using Cameras = std::vector<ImportedCamera>;
using Importer = std::function<Cameras(const ImportArguments&, const Console&)>;

/// One of the kinds of files that cameras are imported from.
struct Source {
  const char* name;
  const char* description;
  const char* input;  ///< what INPUT is
  bool takes_size;
  const char* example;
  Importer read;
};

/// All cameras as a path, or the one of an image, or the list of names.
int write_imported(const Cameras& imported, const ImportArguments& arguments,
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

void add_source(Command& parent, const Source& source) {
  const auto arguments = std::make_shared<ImportArguments>();
  Command& command = parent.command(source.name, source.description, source.example);
  command.argument("INPUT", arguments->input, source.input).required();
  if (source.takes_size) {
    command.option("--size", "WxH", into(arguments->size, parse_size),
                   "WIDTHxHEIGHT of the images in pixels");
  }
  command.option("--image", "NAME", arguments->choice.image, "Only the camera of this image");
  command.flag(
      "--ignore-distortion", arguments->choice.ignore_distortion,
      "Take cameras with lens distortion as if they had none; without it they are left out");
  command.flag("--list", arguments->list, "Write the names of the images instead");
  command.option("-o,--output", "FILE", arguments->output,
                 "Camera file (default: standard output)");
  command.runs([arguments, read = source.read](const Console& console) {
    return write_imported(read(*arguments, console), *arguments, console);
  });
}

Cameras read_colmap(const ImportArguments& a, const Console&) {
  return import_colmap(a.input);
}

Cameras read_nerf(const ImportArguments& a, const Console& console) {
  const auto [width, height] = a.size.value_or(Size{});
  Warnings warnings;
  Cameras cameras = import_nerf(a.input, width, height, warnings);
  console.warn(warnings);
  return cameras;
}

Cameras read_bop(const ImportArguments& a, const Console&) {
  if (!a.size) throw UsageError("bop needs --size: the file does not have it");
  const auto [width, height] = *a.size;
  return import_bop(a.input, width, height);
}

Cameras read_opengl(const ImportArguments& a, const Console&) {
  return import_opengl(a.input);
}

}  // namespace

void add_import(Command& camera) {
  Command& family = camera.command(
      "import", "Convert the cameras of other programs",
      "  fathom camera import colmap sparse/0 -o cameras.json\n"
      "  fathom camera import nerf transforms.json --size 800x800 -o cameras.json\n"
      "\nCameras with lens distortion are left out with a warning; docs/conventions.md has the "
      "formulas.\nEach camera has the name of its image: render -o 'maps/{stem}.exr' writes maps "
      "of "
      "the same names.");
  family.requires_command();
  add_source(
      family,
      {"colmap", "COLMAP: cameras and images, .bin or .txt", "The folder of the model", false,
       "  fathom camera import colmap sparse/0 --image IMG_0001.jpg -o camera.json", read_colmap});
  add_source(
      family,
      {"nerf", "NeRF, Nerfstudio, instant-ngp: transforms.json", "transforms.json", true,
       "  fathom camera import nerf transforms.json --size 800x800 -o cameras.json", read_nerf});
  add_source(family, {"bop", "BOP: scene_camera.json", "scene_camera.json", true,
                      "  fathom camera import bop scene_camera.json --size 640x480 -o cameras.json",
                      read_bop});
  add_source(family, {"opengl", "OpenGL: projection, modelview and viewport as JSON",
                      "A JSON file with projection, modelview and viewport", false,
                      "  fathom camera import opengl matrices.json -o camera.json", read_opengl});
}

}  // namespace fathom::app
