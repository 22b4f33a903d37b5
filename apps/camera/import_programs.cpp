// fathom camera import colmap | nerf | bop | sfmdata | gltf | opengl

#include "apps/camera/import_sources.h"
#include "fathom/failures/errors.h"

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
          {"opengl", "Import a camera of OpenGL: projection, modelview and viewport as JSON",
           "A JSON file with projection, modelview and viewport",
           "  fathom camera import opengl matrices.json -o camera.json", no_options, read_opengl}};
}

}  // namespace fathom::app
