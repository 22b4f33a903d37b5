#include "fathom/clipping/plane.h"

#include <cmath>
#include <limits>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::clipping {
namespace {

double root(double square) {
  return std::sqrt(square);
}

double root(const Rational& square) {
  return round_sqrt_to_binary64(to_ratio(square));
}

}  // namespace

template <class Number>
Plane<Number> plane_through(const Point3<Number>& Q, const Point3<Number>& N) {
  return {N.x, N.y, N.z, -(Q.x * N.x + Q.y * N.y + Q.z * N.z)};
}

template <class Number>
Point3<Number> normal_of(const Point3<Number>& P, const Point3<Number>& Q,
                         const Point3<Number>& R) {
  const Number ux = Q.x - P.x, uy = Q.y - P.y, uz = Q.z - P.z;
  const Number vx = R.x - P.x, vy = R.y - P.y, vz = R.z - P.z;
  return {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
}

template <class Number>
double length_of(const Point3<Number>& N) {
  return root(Number(N.x * N.x + N.y * N.y + N.z * N.z));
}

template <class Number>
void check_plane(const Plane<Number>& plane) {
  if (plane.A == 0 && plane.B == 0 && plane.C == 0)
    throw InputError("the plane's normal (A, B, C) is zero; expected a plane");
}

template <class Number>
Number value_at(const Plane<Number>& H, const Point3<Number>& P) {
  return H.A * P.x + H.B * P.y + H.C * P.z + H.D;
}

template <class Number>
Number value_at(const Plane<Number>& H, const Point4<Number>& P) {
  return H.A * P.x + H.B * P.y + H.C * P.z + H.D * P.w;
}

template <class Number>
Side side_of(const Plane<Number>& plane, const Point3<Number>& point) {
  return static_cast<Side>(sign_of(value_at(plane, point)));
}

template <class Number>
Side side_of(const Plane<Number>& plane, const Point4<Number>& point) {
  if (point.w == 0 && point.x == 0 && point.y == 0 && point.z == 0)
    throw InputError("(0, 0, 0, 0) is no point; expected a coordinate other than 0");
  const int value = sign_of(value_at(plane, point));
  return static_cast<Side>(point.w < 0 ? -value : value);
}

template <class Number>
double signed_distance(const Plane<Number>& plane, const Point4<Number>& point) {
  const StandardArithmetic standard;
  check_plane(plane);
  const double side = static_cast<int>(side_of(plane, point));
  if (point.w == 0) return side == 0 ? 0 : side * std::numeric_limits<double>::infinity();
  const Number value = value_at(plane, point) / point.w;
  const Number N_squared = plane.A * plane.A + plane.B * plane.B + plane.C * plane.C;
  const Number square = value * value / N_squared;
  return side == 0 ? 0 : side * root(square);
}

template <class Number>
std::optional<PlaneLineIntersection<Number>> plane_line_intersection(const Plane<Number>& plane,
                                                                     const Point3<Number>& R,
                                                                     const Point3<Number>& S) {
  const StandardArithmetic standard;
  check_plane(plane);
  const Number along =
      (S.x - R.x) * plane.A + (S.y - R.y) * plane.B + (S.z - R.z) * plane.C;  // (S − R)·N
  if (along == 0) return std::nullopt;
  const Number t = -value_at(plane, R) / along;
  return PlaneLineIntersection<Number>{t, interpolate(R, S, t)};
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Number)                                                    \
  template Plane<Number> plane_through(const Point3<Number>&, const Point3<Number>&); \
  template Point3<Number> normal_of(const Point3<Number>&, const Point3<Number>&,     \
                                    const Point3<Number>&);                           \
  template double length_of(const Point3<Number>&);                                   \
  template void check_plane(const Plane<Number>&);                                    \
  template Number value_at(const Plane<Number>&, const Point3<Number>&);              \
  template Number value_at(const Plane<Number>&, const Point4<Number>&);              \
  template Side side_of(const Plane<Number>&, const Point3<Number>&);                 \
  template Side side_of(const Plane<Number>&, const Point4<Number>&);                 \
  template double signed_distance(const Plane<Number>&, const Point4<Number>&);       \
  template std::optional<PlaneLineIntersection<Number>> plane_line_intersection(      \
      const Plane<Number>&, const Point3<Number>&, const Point3<Number>&);
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(Rational)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::clipping
