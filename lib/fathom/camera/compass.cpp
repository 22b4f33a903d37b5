#include "fathom/camera/compass.h"

#include <cmath>

#include "fathom/camera/sine_cosine.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {

std::array<double, 3> compass_direction(double azimuth, double elevation) {
  const StandardArithmetic standard;
  if (!std::isfinite(azimuth)) throw UsageError("the azimuth is not finite");
  if (!(elevation >= -90 && elevation <= 90)) {
    throw UsageError("the elevation must be between -90 and 90 degrees");
  }
  const camera::SineCosine a = camera::sine_and_cosine(azimuth),
                           e = camera::sine_and_cosine(elevation);
  return {camera::rounded_product(e.cosine, a.sine), camera::rounded_product(e.cosine, a.cosine),
          e.sine.rounded};
}

}  // namespace fathom
