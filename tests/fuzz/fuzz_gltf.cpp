#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/scene/bounds.h"
#include "fathom/scene/framing.h"
#include "tests/fuzz/fuzz_mesh.h"

/// Any bytes as a glTF asset: an InputError of one line, or a scene that keeps its promises.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fathom;
  using namespace fathom::mesh_files;
  Scene scene;
  Warnings warnings;
  ReadOptions options;
  options.attributes = options.primitives = options.segments = size % 2 == 0;
  options.hash = false;
  try {
    GltfAsset asset = read_gltf(std::as_bytes(std::span(data, size)), "input", options, warnings);
    scene.meshes = std::move(asset.meshes);
    scene.objects = std::move(asset.objects);
    scene.sources = std::move(asset.buffers);
  } catch (const InputError& e) {
    if (std::string(e.what()).find('\n') != std::string::npos) std::abort();
    return 0;
  }
  for (const Object& object : scene.objects)
    if (object.mesh >= scene.meshes.size()) std::abort();
  for (const Mesh& mesh : scene.meshes) fuzz::check(mesh);
  world_bounds(scene);
  return 0;
}
