#include "fathom/triangle/sampling.h"

#include <limits>

namespace fathom {

bool is_in_range(const Ratio& depth, const Camera& camera) {
  if (depth.sign() != Sign::positive || depth < Ratio(Dyadic(camera.near))) return false;
  return camera.far == std::numeric_limits<double>::infinity() ||
         !(Ratio(Dyadic(camera.far)) < depth);
}

}  // namespace fathom
