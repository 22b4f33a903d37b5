#pragma once

#include <array>
#include <string>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/scene/read_scene.h"
#include "tests/places.h"
#include "tests/scratch_folder.h"

namespace fathom::test {

/// Reads a file of this name with these bytes, by the fathom-formats that was built.
inline Scene read_bytes(const std::string& name, const std::string& bytes, Warnings& warnings,
                        ReadOptions options = {}) {
  const ScratchFolder folder;
  const auto path = folder.write(name, bytes);
  options.formats_program = [] { return program("fathom-formats"); };
  Scene scene = read_scene({path}, options, warnings);
  return scene;
}

inline Scene read_bytes(const std::string& name, const std::string& bytes) {
  Warnings warnings;
  return read_bytes(name, bytes, warnings);
}

/// The message of the InputError, without the name of the folder.
inline std::string refusal_of(const std::string& name, const std::string& bytes) {
  const std::string message = message_of<InputError>([&] { read_bytes(name, bytes); });
  return message.substr(std::min(message.find(name), message.size()));
}

using ExactCorner = std::array<Dyadic, 3>;

/// The corners of all triangles in the world.
inline std::vector<ExactCorner> corners_in_world(const Scene& scene) {
  std::vector<ExactCorner> corners;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    for (const CornerIndices& triangle : mesh.triangles) {
      for (const std::uint32_t vertex : triangle) {
        const WorldPoint p = to_world(object, mesh.vertices[vertex]);
        corners.push_back({p.x, p.y, p.z});
      }
    }
  }
  return corners;
}

}  // namespace fathom::test
