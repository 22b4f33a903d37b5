#include "fathom/attribution/faults/shift_estimate.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace fathom::attribution {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Pixels on which an estimate has to rest.
constexpr std::size_t least_pixels = 16;

/// What is linear in a shift within one triangle: inverse depths (perspective) or depths
/// (orthographic).
double affine_value(const Camera& camera, double depth) {
  return camera.projection == Projection::perspective ? 1 / depth : depth;
}

/// The normal equations of r = g·shift, g the gradient and r the difference at a pixel.
struct NormalEquations {
  double xx = 0, xy = 0, yy = 0, xr = 0, yr = 0;
  double residuals = 0;  ///< sum of |r − g·shift| of the shift before
  std::size_t pixels = 0;
};

/// Over the pixels whose neighbours to the right and below show the same triangle, without those
/// whose residual is beyond `limit`.
NormalEquations equations(const Truth& truth, const OtherMap& other, const ImageShift& shift,
                          double limit) {
  const Camera& camera = truth.camera;
  NormalEquations sums;
  for (std::uint32_t y = 0; y + 1 < camera.height; ++y) {
    for (std::uint32_t x = 0; x + 1 < camera.width; ++x) {
      const std::size_t i = std::size_t{y} * camera.width + x;
      const std::size_t below = i + camera.width;
      const bool is_flat = truth.triangles[i] == truth.triangles[i + 1] &&
                           truth.triangles[i] == truth.triangles[below];
      if (!is_flat || !(truth.depths[i] < infinity) || !(other.depths[i] < infinity)) continue;
      const double here = affine_value(camera, truth.depths[i]);
      const double gx = affine_value(camera, truth.depths[i + 1]) - here;
      const double gy = affine_value(camera, truth.depths[below]) - here;
      const double r = affine_value(camera, other.depths[i]) - here;
      const double residual = std::abs(r - gx * shift.x - gy * shift.y);
      if (residual > limit) continue;
      sums.residuals += residual;
      ++sums.pixels;
      sums.xx += gx * gx;
      sums.xy += gx * gy;
      sums.yy += gy * gy;
      sums.xr += gx * r;
      sums.yr += gy * r;
    }
  }
  return sums;
}

}  // namespace

/// Three times, from the second time on without the worst.
std::optional<ImageShift> estimated_shift(const Truth& truth, const OtherMap& other) {
  ImageShift shift;
  double limit = infinity;
  for (int round = 0; round < 3; ++round) {
    const NormalEquations s = equations(truth, other, shift, limit);
    const double determinant = s.xx * s.yy - s.xy * s.xy;
    if (s.pixels < least_pixels || !(determinant > 1e-9 * s.xx * s.yy)) return std::nullopt;
    shift = {(s.yy * s.xr - s.xy * s.yr) / determinant, (s.xx * s.yr - s.xy * s.xr) / determinant};
    limit = 3 * s.residuals / static_cast<double>(s.pixels);
  }
  if (!(std::hypot(shift.x, shift.y) < 4)) return std::nullopt;
  return shift;
}

}  // namespace fathom::attribution
