#include "fathom/pipeline/scan/bezier.h"

#include <algorithm>
#include <cmath>

#include "fathom/failures/errors.h"

namespace fathom::pipeline {
namespace {

PlanePoint between(const PlanePoint& a, const PlanePoint& b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

double second_difference(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return std::hypot(a.x - 2 * b.x + c.x, a.y - 2 * b.y + c.y);
}

void add_chords(const CubicBezier& curve, double tolerance, std::vector<PlanePoint>& points) {
  if (chord_error(curve) <= tolerance) {
    points.push_back(curve.control[3]);
    return;
  }
  for (const CubicBezier& half : curve.divided_at(0.5)) add_chords(half, tolerance, points);
}

double extent(const CubicBezier& curve) {
  double greatest = 0;
  for (const PlanePoint& p : curve.control)
    for (const PlanePoint& q : curve.control)
      greatest = std::max(greatest, std::hypot(p.x - q.x, p.y - q.y));
  return greatest;
}

}  // namespace

PlanePoint CubicBezier::at(double t) const {
  return divided_at(t)[0].control[3];
}

std::array<CubicBezier, 2> CubicBezier::divided_at(double t) const {
  const auto& [a, b, c, d] = control;
  const PlanePoint ab = between(a, b, t), bc = between(b, c, t), cd = between(c, d, t);
  const PlanePoint abc = between(ab, bc, t), bcd = between(bc, cd, t);
  const PlanePoint point = between(abc, bcd, t);
  return {{{{a, ab, abc, point}}, {{point, bcd, cd, d}}}};
}

CubicBezier CubicBezier::scaled(double factor) const {
  CubicBezier result = *this;
  for (PlanePoint& p : result.control) p = {factor * p.x, factor * p.y};
  return result;
}

double chord_error(const CubicBezier& curve) {
  const auto& [a, b, c, d] = curve.control;
  return 0.75 * std::max(second_difference(a, b, c), second_difference(b, c, d));
}

std::vector<PlanePoint> flattened(const CubicBezier& curve, double tolerance) {
  const bool finite = std::all_of(curve.control.begin(), curve.control.end(), [](const auto& p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
  });
  if (!finite) throw UsageError("a Bézier curve has a control point that is not finite");
  if (!(tolerance > 0) || !(tolerance >= std::ldexp(extent(curve), -40)))
    throw UsageError("the tolerance of a Bézier curve is below what its numbers tell apart");
  std::vector<PlanePoint> points{curve.control[0]};
  add_chords(curve, tolerance, points);
  return points;
}

// The integral of products of Bernstein's polynomials: with the cross products of the control
// points, (6·b₀×b₁ + 3·b₀×b₂ + b₀×b₃ + 3·b₁×b₂ + 3·b₁×b₃ + 6·b₂×b₃)/20.
double area_beside(const CubicBezier& curve) {
  const auto& p = curve.control;
  const auto cross = [&](std::size_t i, std::size_t k) {
    return p[i].x * p[k].y - p[i].y * p[k].x;
  };
  return (6 * cross(0, 1) + 3 * cross(0, 2) + cross(0, 3) + 3 * cross(1, 2) + 3 * cross(1, 3) +
          6 * cross(2, 3)) /
         20;
}

}  // namespace fathom::pipeline
