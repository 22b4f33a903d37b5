#include "fathom/lens/iterated_inverses.h"

#include <algorithm>
#include <cmath>

namespace fathom::lens {
namespace {

/// The step of Newton's method from m, to be subtracted.
PlanePoint newton_step(const StageNumbers<double>& stage, const PlanePoint& y,
                       const PlanePoint& m) {
  const auto [x_d, y_d] = stage_value<double>(stage, m[0], m[1]);
  const auto [xx, xy, yx, yy] = stage_jacobian<double>(stage, m[0], m[1]);
  const double determinant = xx * yy - xy * yx, off_x = x_d - y[0], off_y = y_d - y[1];
  return {(yy * off_x - xy * off_y) / determinant, (xx * off_y - yx * off_x) / determinant};
}

}  // namespace

PlanePoint invert_by_fixed_point(const StageNumbers<double>& stage, const PlanePoint& y,
                                 int steps) {
  const double p1 = stage.p1, p2 = stage.p2;
  auto [x_m, y_m] = y;
  for (int step = 0; step < steps; ++step) {
    const double q = x_m * x_m + y_m * y_m;
    const double reciprocal = horner(stage.denominator, q) / horner(stage.numerator, q);
    if (reciprocal < 0) return y;
    const double along_x =
        2 * p1 * x_m * y_m + p2 * (q + 2 * x_m * x_m) + stage.s1 * q + stage.s2 * q * q;
    const double along_y =
        p1 * (q + 2 * y_m * y_m) + 2 * p2 * x_m * y_m + stage.s3 * q + stage.s4 * q * q;
    x_m = (y[0] - along_x) * reciprocal;
    y_m = (y[1] - along_y) * reciprocal;
  }
  return {x_m, y_m};
}

PlanePoint invert_by_residuals(const StageNumbers<double>& stage, const PlanePoint& y, int steps) {
  PlanePoint m = y;
  for (int i = 0; i < steps; ++i) {
    const auto [x_d, y_d] = stage_value<double>(stage, m[0], m[1]);
    m = {m[0] + y[0] - x_d, m[1] + y[1] - y_d};
  }
  return m;
}

PlanePoint invert_by_newton(const StageNumbers<double>& stage, const PlanePoint& y, int steps) {
  PlanePoint m = y;
  for (int i = 0; i < steps; ++i) {
    const PlanePoint step = newton_step(stage, y, m);
    m = {m[0] - step[0], m[1] - step[1]};
  }
  return m;
}

std::optional<PlanePoint> invert_as_colmap(const StageNumbers<double>& stage, const PlanePoint& y) {
  constexpr int most_steps = 100;
  constexpr double last_step = 1e-5, longest_step = 0.1, longest_part = 0.1;
  PlanePoint m = y;
  for (int i = 0; i < most_steps; ++i) {
    const PlanePoint step = newton_step(stage, y, m);
    const double size = std::hypot(step[0], step[1]);
    const double longest = std::max(longest_part * std::hypot(m[0], m[1]), longest_step);
    const double share = size > longest ? longest / size : 1;
    m = {m[0] - share * step[0], m[1] - share * step[1]};
    if (share * size < last_step) return m;
  }
  return std::nullopt;
}

}  // namespace fathom::lens
