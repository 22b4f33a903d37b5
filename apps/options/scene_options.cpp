#include "apps/options/scene_options.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "apps/shell/known_files.h"
#include "apps/shell/values.h"
#include "fathom/failures/errors.h"
#include "fathom/image/map_files.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {
namespace {

/// A map is a common mistake, since maps carry their camera, but no scene.
void refuse_map(const std::string& file) {
  const std::optional<MapFormat> format = map_format_of(file);
  std::error_code error;
  if (!format || *format == MapFormat::colmap || !std::filesystem::is_regular_file(file, error))
    return;
  throw InputError(file + ": is a map, expected a mesh or a scene file; '--camera " + file +
                   "' takes the camera that a map carries");
}

}  // namespace

int parse_thread_count(const std::string& text) {
  const std::uint32_t count = parse_count(text);
  if (count > 1024) throw UsageError("'" + text + "' is more than 1024");
  return static_cast<int>(count);
}

MeshFormat parse_mesh_format(const std::string& text) {
  return parse_word<MeshFormat>(text, {{"obj", MeshFormat::obj},
                                       {"ply", MeshFormat::ply},
                                       {"stl", MeshFormat::stl},
                                       {"off", MeshFormat::off},
                                       {"gltf", MeshFormat::gltf},
                                       {"glb", MeshFormat::gltf}});
}

void SceneOptions::add_to(Command& command) {
  command
      .arguments(
          "SCENE", files,
          "Meshes (OBJ, PLY, STL, OFF, glTF/GLB; FBX, COLLADA, 3DS, 3MF and others by assimp) "
          "and scene files (JSON); - is standard input")
      .required();
  add_reading_to(command);
}

void SceneOptions::add_reading_to(Command& command) {
  command.option("--mesh-format", "NAME", into(mesh_format, parse_mesh_format),
                 "Format of the meshes: obj, ply, stl, off, gltf or glb (default: by content)");
  command.option("--threads", "N", into(threads, parse_thread_count),
                 "Threads to use (default 0: all)");
  limits.add_to(command);
}

ReadOptions SceneOptions::read_options() const {
  ReadOptions options = limits.read_options();
  options.format = mesh_format;
  options.threads = threads;
  return options;
}

Scene SceneOptions::read(const Console& console, const Extras& extras) const {
  const auto standard_inputs = std::count(files.begin(), files.end(), "-");
  if (standard_inputs > 1) throw UsageError("SCENE: '-', standard input, can be read only once");
  if (!mesh_format) std::ranges::for_each(files, refuse_map);
  ReadOptions options = read_options();
  options.hash = extras.hash;
  options.attributes = extras.attributes;
  options.primitives = extras.primitives;
  options.segments = extras.segments;
  Warnings warnings;
  Scene scene = read_scene({files.begin(), files.end()}, options, warnings);
  console.warn(warnings);
  for (const std::string& file : files) note_input(file);
  for (const Source& source : scene.sources) note_input(source.path);
  return scene;
}

}  // namespace fathom::app
