#include "fathom/triangle/ray_surface.h"

namespace fathom::triangle {

RaySurface::RaySurface(const ProjectedTriangle& t, const Wanted& wanted)
    : wanted_(wanted), weight_(t.weight) {
  if (wanted.position) position_ = position_forms(t);
  if (wanted.barycentric) barycentric_ = {t.edges[1], t.edges[2]};
  if (wanted.distance) volume_ = t.volume;
  if (wanted.depth) depth_ = t.depth_numerator;
}

bool RaySurface::write(std::size_t pixel, const RayBox& box,
                       const rendering::ChannelValues& values) const {
  const auto settle = [&](float* channel, const LinearForm& form) {
    const auto settled = binary32_in(box, form, weight_);
    if (settled) channel[pixel] = *settled;
    return settled.has_value();
  };
  if (wanted_.position) {
    for (std::size_t k = 0; k < 3; ++k)
      if (!settle(values.position[k], position_[k])) return false;
  }
  if (wanted_.barycentric) {
    for (std::size_t k = 0; k < 2; ++k)
      if (!settle(values.barycentric[k], barycentric_[k])) return false;
  }
  if (wanted_.depth && !settle(values.depth.binary32, depth_)) return false;
  if (wanted_.distance) {
    const auto settled = distance_in(box, volume_, weight_);
    if (!settled) return false;
    values.distance.binary32[pixel] = *settled;
  }
  return true;
}

}  // namespace fathom::triangle
