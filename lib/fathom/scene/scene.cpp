#include "fathom/scene/scene.h"

#include "fathom/scene/triangle_source.h"

namespace fathom {

DrawState draw_state_of(const Scene& scene, std::size_t object) {
  return scene.draw_states.empty() ? DrawState() : scene.draw_states[object];
}

std::uint64_t triangle_count(const Scene& scene) {
  return TriangleSource(scene).count();
}

TriangleOrigin origin_of(const Scene& scene, std::uint32_t number) {
  return TriangleSource(scene).origin(number);
}

}  // namespace fathom
