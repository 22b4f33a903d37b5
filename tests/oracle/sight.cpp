#include "tests/oracle/sight.h"

#include <algorithm>

namespace fathom::oracle {
namespace {

Vector way(const Vector& from, const Vector& to) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

Q product(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector normal(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Whether a point of the plane of the triangle lies on no outer side of an edge.
bool has_point(const Triangle& triangle, const Vector& n, const Vector& point) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector along = way(triangle[i], triangle[(i + 1) % 3]);
    if (product(normal(along, way(triangle[i], point)), n) < 0) return false;
  }
  return true;
}

bool hides(const Triangle& triangle, const Vector& p, const Vector& q) {
  const Vector n = normal(way(triangle[0], triangle[1]), way(triangle[0], triangle[2]));
  const Q of_p = product(n, way(triangle[0], p)), of_q = product(n, way(triangle[0], q));
  if (sgn(of_p) * sgn(of_q) >= 0) return false;
  const Q share = of_p / (of_p - of_q);
  Vector at;
  for (std::size_t k = 0; k < 3; ++k) at[k] = p[k] + share * (q[k] - p[k]);
  return has_point(triangle, n, at);
}

}  // namespace

Vector point_of(const Triangle& triangle, const Q& v, const Q& w) {
  Vector point;
  for (std::size_t k = 0; k < 3; ++k)
    point[k] = triangle[0][k] + v * (triangle[1][k] - triangle[0][k]) +
               w * (triangle[2][k] - triangle[0][k]);
  return point;
}

bool see_each_other(const Vector& p, const Vector& q, const std::vector<Triangle>& triangles) {
  return std::ranges::none_of(triangles, [&](const Triangle& t) { return hides(t, p, q); });
}

}  // namespace fathom::oracle
