#include "fathom/camera/rounded_angles.h"

#include <cmath>

#include "fathom/numeric/rounding.h"
#include "fathom/numeric/transcendental.h"

namespace fathom::camera {

SineCosine sine_and_cosine(double degrees) {
  int quarter = 0;
  const double rest = std::remquo(degrees, 90.0, &quarter);
  const Real sine = sine_of_degrees(std::abs(rest)), cosine = cosine_of_degrees(std::abs(rest));
  const Signed s{sine, std::copysign(round_to_binary64(sine), rest)};
  const Signed c{cosine, round_to_binary64(cosine)};
  switch (quarter & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double rounded_product(const Signed& a, const Signed& b) {
  return std::copysign(round_product_to_binary64(a.magnitude, b.magnitude), a.rounded * b.rounded);
}

namespace {

double half_of(std::uint32_t size, const Real& cotangent) {
  return round_to_binary64(affine(cotangent, Ratio(size / 2.0), Ratio()));
}

}  // namespace

double focal_of_degrees(std::uint32_t size, double angle) {
  return half_of(size, cotangent_of_half_degrees(angle));
}

double focal_of_radians(std::uint32_t size, double angle) {
  return half_of(size, cotangent_of_half_radians(angle));
}

}  // namespace fathom::camera
