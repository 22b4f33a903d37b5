#include "apps/study/lens/inverses.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace fathom::studies {

PlanePoint invert_by_fixed_point(const lens::StageNumbers<double>& stage, const PlanePoint& y,
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

std::optional<PlanePoint> invert_by_newton(const lens::StageNumbers<double>& stage,
                                           const PlanePoint& y) {
  constexpr int most_steps = 100;
  constexpr double last_step = 1e-5, longest_step = 0.1, longest_part = 0.1;
  Eigen::Vector2d m(y[0], y[1]);
  for (int i = 0; i < most_steps; ++i) {
    const auto [x_d, y_d] = lens::stage_value<double>(stage, m.x(), m.y());
    const auto [xx, xy, yx, yy] = lens::stage_jacobian<double>(stage, m.x(), m.y());
    const Eigen::Matrix2d jacobian{{xx, xy}, {yx, yy}};
    Eigen::Vector2d step = jacobian.partialPivLu().solve(Eigen::Vector2d(x_d - y[0], y_d - y[1]));
    const double longest = std::max(longest_part * m.norm(), longest_step);
    if (step.norm() > longest) step *= longest / step.norm();
    m -= step;
    if (step.norm() < last_step) return PlanePoint{m.x(), m.y()};
  }
  return std::nullopt;
}

}  // namespace fathom::studies
