#include "fathom/pipeline/geometry/plane_sides.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/certified.h"

namespace fathom::pipeline {
namespace {

Sign exact_side(const Point3d& a, const Point3d& b, const Point3d& c, const Point3d& p) {
  const auto minus = [&](const Point3d& q) {
    return ExactVector3{Dyadic(q[0]) - a[0], Dyadic(q[1]) - a[1], Dyadic(q[2]) - a[2]};
  };
  return determinant(minus(b), minus(c), minus(p)).sign();
}

/// Whether an edge of `p` has all of `q` on its outer side or on it.
bool separates(const std::vector<Point3d>& p, const std::vector<Point3d>& q) {
  Sign inner = Sign::zero;
  for (std::size_t i = 2; i < p.size() && inner == Sign::zero; ++i)
    inner = turn_in_window(p[0], p[i - 1], p[i]);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto &a = p[i], &b = p[(i + 1) % p.size()];
    if (a[0] == b[0] && a[1] == b[1]) continue;
    if (std::none_of(q.begin(), q.end(),
                     [&](const Point3d& c) { return turn_in_window(a, b, c) == inner; }))
      return true;
  }
  return false;
}

}  // namespace

Sign side_of_plane(const Point3d& a, const Point3d& b, const Point3d& c, const Point3d& p) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  const double wx = p[0] - a[0], wy = p[1] - a[1], wz = p[2] - a[2];
  const double d = ux * (vy * wz - vz * wy) - uy * (vx * wz - vz * wx) + uz * (vx * wy - vy * wx);
  // Differences have one rounding, each term two products and one more difference, then two sums:
  // the relative errors of the six products of three are below (1 + 2⁻⁵³)⁸ − 1 < 2⁻⁴⁹ of their sum.
  const double size = std::abs(ux) * (std::abs(vy * wz) + std::abs(vz * wy)) +
                      std::abs(uy) * (std::abs(vx * wz) + std::abs(vz * wx)) +
                      std::abs(uz) * (std::abs(vx * wy) + std::abs(vy * wx));
  if (size > 0x1p-900 && std::abs(d) > size * 0x1p-49)
    return d > 0 ? Sign::positive : Sign::negative;
  return exact_side(a, b, c, p);
}

Sign turn_in_window(const Point3d& a, const Point3d& b, const Point3d& c) {
  return orientation({a[0], a[1]}, {b[0], b[1]}, {c[0], c[1]});
}

bool projections_overlap(const std::vector<Point3d>& p, const std::vector<Point3d>& q) {
  return !separates(p, q) && !separates(q, p);
}

}  // namespace fathom::pipeline
