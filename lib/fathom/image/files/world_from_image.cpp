#include "fathom/image/files/world_from_image.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::image {
namespace {

struct ImageVector {
  Dyadic u, v;
};

ImageVector operator-(const ImageVector& a, const ImageVector& b) {
  return {a.u - b.u, a.v - b.v};
}

/// Of an orthographic camera, so that nothing is divided.
ImageVector image_of(const Camera& camera, const WorldPoint& X) {
  const HomogeneousImagePoint p = to_image(camera.projection, to_camera(camera.world_to_camera, X));
  return {p.U, p.V};
}

}  // namespace

std::optional<WorldFromImage> world_from_image(const Camera& camera) {
  const StandardArithmetic standard;
  if (!is_orthographic(camera.projection) || find_fault(camera)) return std::nullopt;
  const ImageVector o = image_of(camera, {0, 0, 0});
  const ImageVector x = image_of(camera, {1, 0, 0}) - o;
  const ImageVector y = image_of(camera, {0, 1, 0}) - o;
  const ImageVector z = image_of(camera, {0, 0, 1}) - o;
  // Points above each other have the same image.
  if (!z.u.is_zero() || !z.v.is_zero()) return std::nullopt;

  // (u, v) = o + X·x + Y·y, solved by Cramer's rule; x and y are independent, as the camera is
  // regular.
  const Dyadic det = x.u * y.v - y.u * x.v;
  const auto over_det = [&](const Dyadic& numerator) {
    return round_to_binary64(Ratio(numerator, det));
  };
  const WorldFromImage g{over_det(y.u * o.v - y.v * o.u), over_det(y.v),  over_det(-y.u),
                         over_det(x.v * o.u - x.u * o.v), over_det(-x.v), over_det(x.u)};
  const bool fits = std::ranges::all_of(g, [](double each) { return std::isfinite(each); });
  return fits ? std::optional(g) : std::nullopt;
}

}  // namespace fathom::image
