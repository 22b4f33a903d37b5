// fathom camera import colmap | nerf | bop | sfmdata | gltf | blender | opengl

#include <fmt/core.h>

#include <memory>

#include "apps/camera/import_sources.h"
#include "apps/shell/command.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/text/printable.h"

namespace fathom::app {
namespace {

using Cameras = std::vector<ImportedCamera>;

void no_options(Command&, ImportArguments&) {}

Cameras read_colmap(const ImportArguments& a, Warnings&) {
  return import_colmap(a.input);
}

Cameras read_nerf(const ImportArguments& a, Warnings& warnings) {
  const auto [width, height] = a.size.value_or(Size{});
  return import_nerf(a.input, width, height, warnings);
}

Cameras read_bop(const ImportArguments& a, Warnings&) {
  const auto [width, height] = a.size.value_or(Size{});
  return import_bop(a.input, width, height);
}

Cameras read_sfm_data(const ImportArguments& a, Warnings&) {
  return import_sfm_data(a.input);
}

Cameras read_gltf(const ImportArguments& a, Warnings&) {
  if (!a.size) throw UsageError("gltf needs --size: glTF's cameras have no image size");
  const auto [width, height] = *a.size;
  return import_gltf(a.input, width, height);
}

Cameras read_blender(const ImportArguments& a, Warnings&) {
  return import_blender(a.input);
}

Cameras read_opengl(const ImportArguments& a, Warnings&) {
  return import_opengl(a.input);
}

}  // namespace

void add_size_option(Command& command, ImportArguments& arguments) {
  command.option("--size", "WxH", into(arguments.size, parse_size),
                 "Size of the images in pixels, WIDTHxHEIGHT");
}

void add_distortion_option(Command& command, CameraChoice& choice) {
  command.flag(
      "--ignore-distortion", choice.ignore_distortion,
      "Import all lenses as pinholes; without this option lenses that have no model are left out");
}

std::vector<ImportSource> program_sources() {
  return {{"colmap", "Import cameras of COLMAP: cameras and images, .bin or .txt",
           "The folder of the model",
           "  fathom camera import colmap sparse/0 --image IMG_0001.jpg -o camera.json", no_options,
           read_colmap},
          {"nerf", "Import cameras of NeRF, Nerfstudio or instant-ngp: transforms.json",
           "transforms.json",
           "  fathom camera import nerf transforms.json --size 800x800 -o cameras.json",
           add_size_option, read_nerf},
          {"bop", "Import cameras of BOP: scene_camera.json",
           "The folder of a scene, or its scene_camera.json",
           "  fathom camera import bop test/000001 -o cameras.json\n"
           "  fathom camera import bop scene_camera.json --size 640x480 -o cameras.json\n"
           "\nWithout --size, the size is read from the data set's camera.json, in the scene's "
           "folder or one of the two folders above.",
           add_size_option, read_bop},
          {"sfmdata", "Import cameras of AliceVision (Meshroom): sfmData as JSON", "cameras.sfm",
           "  fathom camera import sfmdata cameras.sfm -o cameras.json\n"
           "\nMeshroom's meshes have y and z reversed relative to its cameras: data-sets.md in the "
           "documentation.",
           no_options, read_sfm_data},
          {"gltf", "Import the cameras of a glTF scene", "model.gltf or model.glb",
           "  fathom camera import gltf model.glb --size 1920x1080 -o cameras.json",
           add_size_option, read_gltf},
          {"blender", "Import cameras of Blender: JSON of export_cameras.py",
           "The JSON file that export_cameras.py writes",
           "  blender -b scene.blend --python export_cameras.py -- cameras.json\n"
           "  fathom camera import blender cameras.json --image Camera -o camera.json\n"
           "\nThe script is in blender/ of the documentation.",
           no_options, read_blender},
          {"opengl", "Import a camera of OpenGL: projection, modelview and viewport as JSON",
           "A JSON file with projection, modelview and viewport",
           "  fathom camera import opengl matrices.json -o camera.json", no_options, read_opengl}};
}

// fathom camera import …: what all kinds of files have in common

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
  if (source.has_pinholes) add_distortion_option(command, arguments->choice);
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
