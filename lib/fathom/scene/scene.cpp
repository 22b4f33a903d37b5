#include "fathom/scene/scene.h"

#include <cmath>

#include "fathom/scene/triangle_source.h"

namespace fathom {

bool is_default(const DrawState& s) {
  return !s.depth_test && s.depth_write && s.colour_write && !s.polygon_offset && !s.alpha &&
         !s.stencil;
}

std::optional<std::string> find_fault(const DrawState& s) {
  if (s.polygon_offset &&
      !(std::isfinite(s.polygon_offset->factor) && std::isfinite(s.polygon_offset->units)))
    return "a polygon offset that is not finite";
  if (s.alpha && !(*s.alpha >= 0 && *s.alpha <= 1)) return "an opacity that is not from 0 to 1";
  return std::nullopt;
}

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
