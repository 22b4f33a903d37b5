#include "fathom/camera/focal_length.h"

#include "fathom/numeric/trigonometry.h"

namespace fathom::camera {
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
