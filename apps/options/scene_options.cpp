#include "apps/options/scene_options.h"

#include <algorithm>
#include <map>
#include <optional>

#include "apps/shell/known_files.h"
#include "apps/shell/numbers.h"
#include "fathom/numeric/errors.h"
#include "fathom/scene/read_scene.h"

namespace fathom::app {
namespace {

MeshFormat mesh_format_named(const std::string& name) {
  static const std::map<std::string, MeshFormat> formats{
      {"obj", MeshFormat::obj}, {"ply", MeshFormat::ply},   {"stl", MeshFormat::stl},
      {"off", MeshFormat::off}, {"gltf", MeshFormat::gltf}, {"glb", MeshFormat::gltf}};
  const auto found = formats.find(name);
  if (found == formats.end()) {
    throw UsageError("--mesh-format: '" + name + "' is none of obj, ply, stl, off, gltf and glb");
  }
  return found->second;
}

}  // namespace

void SceneOptions::add_to(CLI::App& command) {
  command
      .add_option("SCENE", files,
                  "Meshes (OBJ, PLY, STL, OFF, glTF/GLB) and scene files (JSON); - is a mesh on "
                  "standard input")
      ->required();
  command.add_option("--mesh-format", mesh_format,
                     "Format of the meshes: obj, ply, stl, off, gltf or glb (default: by content; "
                     "needed for -)");
  command.add_option("--threads", threads, "Threads to use (default 0: all)");
}

int SceneOptions::thread_count() const {
  const std::uint32_t count = parse_count("--threads", threads);
  if (count > 1024) throw UsageError("--threads: '" + threads + "' is more than 1024");
  return static_cast<int>(count);
}

ReadOptions SceneOptions::read_options(bool hash) const {
  ReadOptions options;
  if (!mesh_format.empty()) options.format = mesh_format_named(mesh_format);
  options.threads = thread_count();
  options.hash = hash;
  return options;
}

Scene SceneOptions::read(const Console& console, bool hash, bool attributes) const {
  const auto standard_inputs = std::count(files.begin(), files.end(), "-");
  if (standard_inputs > 1) throw UsageError("SCENE: '-', standard input, can be read only once");
  if (standard_inputs == 1 && mesh_format.empty()) {
    throw UsageError("SCENE: '-', standard input, needs --mesh-format");
  }
  Warnings warnings;
  ReadOptions options = read_options(hash);
  options.attributes = attributes;
  Scene scene = read_scene({files.begin(), files.end()}, options, warnings);
  console.warn(warnings);
  for (const std::string& file : files) note_input(file);
  for (const Source& source : scene.sources) note_input(source.path);
  return scene;
}

StreamedScene SceneOptions::stream(const Console& console) const {
  if (std::count(files.begin(), files.end(), "-") > 0) {
    throw UsageError("--stream: '-', standard input, cannot be read in parts; expected files");
  }
  Warnings warnings;
  StreamedScene scene = stream_scene({files.begin(), files.end()}, read_options(true), warnings);
  console.warn(warnings);
  for (const std::string& file : files) note_input(file);
  return scene;
}

}  // namespace fathom::app
