#include "fathom/scene/draw_state.h"

#include <cmath>

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

}  // namespace fathom
