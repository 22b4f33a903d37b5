#include <algorithm>
#include <cmath>
#include <iterator>

#include "fathom/failures/errors.h"
#include "fathom/image/convert.h"
#include "fathom/numeric/certified.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {

void require_valid(const MapView& view) {
  const auto finite = [](double x) { return std::isfinite(x); };
  const double numbers[] = {view.fx, view.fy, view.cx, view.cy, view.skew, view.pixel_centre};
  bool valid = std::all_of(std::begin(numbers), std::end(numbers), finite);
  for (const auto& row : view.world_to_camera) {
    valid = valid && std::all_of(row.begin(), row.end(), finite);
  }
  if (!valid) throw InputError("view: a number is not finite");
  if (view.fx == 0 || view.fy == 0) throw InputError("view: fx or fy is 0");
}

/// By Cramer's rule: the rows of R⁻¹·det R are the cross products of the columns of R.
std::array<std::array<double, 4>, 3> camera_to_world(const MapView& view) {
  const StandardArithmetic standard;
  require_valid(view);
  const auto column = [&](std::size_t k) {
    return ExactVector3{view.world_to_camera[0][k], view.world_to_camera[1][k],
                        view.world_to_camera[2][k]};
  };
  const ExactVector3 a = column(0), b = column(1), c = column(2), t = column(3);
  const Dyadic det = determinant(a, b, c);
  if (det.is_zero()) throw InputError("the camera cannot be inverted: its matrix is singular");
  const std::array<ExactVector3, 3> rows{cross(b, c), cross(c, a), cross(a, b)};
  // Ratio needs a positive denominator.
  const bool flip = det.sign() == Sign::negative;
  const Dyadic denominator = abs(det);
  const auto entry = [&](const Dyadic& numerator) {
    return round_to_binary64(Ratio(flip ? -numerator : numerator, denominator));
  };
  std::array<std::array<double, 4>, 3> inverse{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 3; ++k) inverse[row][k] = entry(rows[row][k]);
    inverse[row][3] = entry(-dot(rows[row], t));
  }
  return inverse;
}

std::array<double, 3> point_at(const MapView& view, double i, double j, double z) {
  const StandardArithmetic standard;
  // (i + ½) − (c + ½ − pixel_centre) = i − c + pixel_centre
  const double y = (j - view.cy + view.pixel_centre) / view.fy;
  const double x = (i - view.cx + view.pixel_centre - view.skew * y) / view.fx;
  if (view.orthographic) return {x, y, z};
  return {x * z, y * z, z};
}

}  // namespace fathom
