#include "fathom/lens/sample_plane.h"

namespace fathom::lens {

SamplePlane::SamplePlane(const Projection& projection)
    : centre_(exact_principal_point(projection)),
      fx_(projection.fx),
      fy_(projection.fy),
      skew_(projection.skew),
      c_(fx_ * fy_) {}

// With U = u − cx', V = v − cy': y_d = V/fy and x_d = (U − skew·y_d)/fx = (U·fy − skew·V)/(fx·fy).
DistortedPoint SamplePlane::at(const Dyadic& u, const Dyadic& v) const {
  const Dyadic U = u - centre_.x, V = v - centre_.y;
  DistortedPoint point{U * fy_ - skew_ * V, V * fx_, c_};
  if (c_.sign() == Sign::negative) point = {-point.a, -point.b, -point.c};
  return point;
}

}  // namespace fathom::lens
