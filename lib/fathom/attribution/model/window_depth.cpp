#include "fathom/attribution/model/window_depth.h"

#include <cmath>
#include <limits>

namespace fathom::attribution {

double WindowDepth::of_depth(double depth) const {
  if (log_range != 0) return std::log(depth / near) / log_range;
  return perspective ? a + b / depth : a * depth + b;
}

double WindowDepth::to_depth(double window) const {
  if (log_range != 0) return near * std::exp(window * log_range);
  if (!perspective) return (window - b) / a;
  const double beyond = window - a;  // of the sign of b in front of the camera
  if (beyond == 0 || (beyond > 0) != (b > 0)) return std::numeric_limits<double>::infinity();
  return b / beyond;
}

WindowDepth window_depth(Projection projection, Mapping mapping, double near, double far) {
  WindowDepth window{.perspective = projection == Projection::perspective,
                     .minus_one_to_one = mapping == Mapping::opengl};
  if (mapping == Mapping::log_ulrich) {
    window.near = near;
    window.log_range = std::log(far / near);
    return window;
  }
  const bool reversed = is_reversed(mapping);
  if (takes_infinite_far(mapping)) {
    window.a = reversed ? 0 : 1;
    window.b = reversed ? near : -near;
    return window;
  }
  const double range = far - near;
  if (window.perspective) {
    window.a = reversed ? -near / range : far / range;
    window.b = (reversed ? far : -far) * near / range;
  } else {
    window.a = (reversed ? -1 : 1) / range;
    window.b = (reversed ? far : -near) / range;
  }
  return window;
}

}  // namespace fathom::attribution
