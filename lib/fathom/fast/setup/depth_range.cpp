#include "fathom/fast/setup/depth_range.h"

#include <cmath>
#include <limits>

namespace fathom::fast {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double above(double x) {
  return std::nextafter(x, infinity);
}
double below(double x) {
  return std::nextafter(x, -infinity);
}

}  // namespace

// Orthographic: q = −D, so q ≤ −near, q ≥ −far, and q < 0: −0 counts as "not known".
// Perspective: a covered sample has D > 0 always; 1/far and 1/near are rounded, so the numbers next
// to them enclose them (far = ∞ gives 0 and near = 0 gives ∞, exact: no limit).
DepthRange depth_range(const Camera& camera) {
  if (is_orthographic(camera.projection)) {
    const double nearest = camera.near > 0 ? -camera.near : below(0.0);
    return {-camera.far, nearest, -camera.far, camera.near > 0 ? -camera.near : 0.0};
  }
  DepthRange range{-infinity, infinity, -infinity, infinity};
  if (camera.far < infinity) {
    range.inside_least = above(1 / camera.far);
    range.outside_least = below(1 / camera.far);
  }
  if (camera.near > 0) {
    range.inside_greatest = below(1 / camera.near);
    range.outside_greatest = above(1 / camera.near);
  }
  return range;
}

}  // namespace fathom::fast
