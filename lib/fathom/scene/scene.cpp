#include "fathom/scene/scene.h"

#include <cassert>

namespace fathom {

std::uint64_t triangle_count(const Scene& scene) {
  std::uint64_t count = 0;
  for (const Object& object : scene.objects) count += scene.meshes[object.mesh].triangles.size();
  return count;
}

TriangleOrigin origin_of(const Scene& scene, std::uint32_t number) {
  std::uint64_t rest = number;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const Mesh& mesh = scene.meshes[object.mesh];
    if (rest < mesh.triangles.size()) {
      const auto triangle = static_cast<std::uint32_t>(rest);
      return {static_cast<std::uint32_t>(i), triangle,
              static_cast<std::uint32_t>(object.first_face + mesh.face_of(triangle))};
    }
    rest -= mesh.triangles.size();
  }
  assert(!"triangle number out of range");
  return {};
}

}  // namespace fathom
