#include "fathom/pipeline/geometry/window_triangle.h"

#include <algorithm>

#include "fathom/numeric/rounding.h"

namespace fathom::pipeline {

template <class Real>
std::array<GridPoint, 3> snapped(const WindowTriangle<Real>& t, int bits) {
  const auto at = [&](std::size_t k) {
    return snap(static_cast<double>(t.corners[k].x), static_cast<double>(t.corners[k].y), bits);
  };
  return {at(0), at(1), at(2)};
}

template <class Real>
Real depth_offset(const WindowTriangle<Real>& t, Storage storage, const DepthBias& bias) {
  if (bias.slope_factor == 0 && bias.constant_factor == 0) return 0;
  const auto number = [](Real x) { return Ratio(Dyadic(static_cast<double>(x))); };
  const auto& [a, b, c] = t.corners;
  const Real ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const Real vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  const Real area = ux * vy - vx * uy;
  const WindowSlopes slopes{number((uz * vy - vz * uy) / area), number((ux * vz - vx * uz) / area),
                            number(std::max({a.z, b.z, c.z}))};
  return static_cast<Real>(round_to_binary64(depth_offset(storage, bias, slopes)));
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define FATHOM_INSTANTIATE(Real)                                               \
  template std::array<GridPoint, 3> snapped(const WindowTriangle<Real>&, int); \
  template Real depth_offset(const WindowTriangle<Real>&, Storage, const DepthBias&);
FATHOM_INSTANTIATE(float)
FATHOM_INSTANTIATE(double)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
