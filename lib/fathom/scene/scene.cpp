#include "fathom/scene/scene.h"

#include "fathom/scene/object_fault.h"
#include "fathom/scene/triangle_source.h"

namespace fathom {

DrawState draw_state_of(const Scene& scene, std::size_t object) {
  return scene.draw_states.empty() ? DrawState() : scene.draw_states[object];
}

std::uint64_t triangle_count(const Scene& scene) {
  scene::require(scene::find_fault_of_objects(scene));
  std::uint64_t count = 0;
  for (const Object& object : scene.objects) count += scene.meshes[object.mesh].triangles.size();
  return count;
}

TriangleOrigin origin_of(const Scene& scene, std::uint32_t number) {
  return TriangleSource(scene).origin(number);
}

}  // namespace fathom
