#include "fathom/rays/exact_ray.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fathom/failures/errors.h"

namespace fathom::rays {
namespace {

/// The sign of s(p→q) = (p − o)×(q − o)·d at the moved origin o + δ, δ = (ε, ε², ε³). It is
/// s − δ·((q − p) × d), without terms of second order in δ: so where s = 0 the first component that
/// is not 0 decides. Zero only where q − p is parallel to d.
Sign sign_of_edge(const Dyadic& s, const ExactVector3& edge, const ExactVector3& direction) {
  if (!s.is_zero()) return s.sign();
  for (const Dyadic& component : cross(edge, direction))
    if (!component.is_zero()) return -component.sign();
  return Sign::zero;
}

ExactVector3 exactly(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

bool is_finite(const Ray& ray) {
  const auto is_number = [](double x) { return std::isfinite(x); };
  return std::ranges::all_of(ray.origin, is_number) &&
         std::ranges::all_of(ray.direction, is_number);
}

ExactVector3 difference(const WorldPoint& a, const WorldPoint& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

ExactRay::ExactRay(const Ray& ray)
    : origin(exactly(ray.origin)), direction(exactly(ray.direction)) {}

ExactRay ray_between(const WorldPoint& from, const WorldPoint& to) {
  return {{from.x, from.y, from.z}, difference(to, from)};
}

std::optional<ExactHit> meet(const ExactRay& ray, const std::array<WorldPoint, 3>& corners,
                             EdgeRule edges) {
  const ExactVector3& d = ray.direction;
  const auto& [a, b, c] = corners;
  ExactHit hit;
  const ExactVector3 p = difference(b, a), r = difference(c, a);
  hit.normal = cross(p, r);
  hit.divisor = dot(hit.normal, d);
  hit.side = hit.divisor.sign();
  if (hit.side == Sign::zero) return std::nullopt;

  const ExactVector3 t{a.x - ray.origin[0], a.y - ray.origin[1], a.z - ray.origin[2]};
  // s(c→a) = d·(r × t) and s(a→b) = d·(t × p) are the weights of B and C; all three add up to n·d.
  hit.weights = {dot(cross(r, t), d), dot(cross(t, p), d)};
  const Dyadic of_a = hit.divisor - hit.weights[0] - hit.weights[1];
  const auto is_inside = [&](const Dyadic& s, const ExactVector3& edge) {
    if (edges == EdgeRule::closed && s.is_zero()) return true;
    return sign_of_edge(s, edge, d) == hit.side;
  };
  if (!is_inside(hit.weights[0], difference(a, c)) || !is_inside(hit.weights[1], p) ||
      !is_inside(of_a, difference(c, b)))
    return std::nullopt;
  hit.t = Ratio(dot(hit.normal, t), hit.divisor);
  return hit;
}

ExactHit require_hit(const ExactRay& ray, const std::array<WorldPoint, 3>& corners) {
  std::optional<ExactHit> hit = meet(ray, corners);
  if (!hit) throw InputError("scene: it has changed since it was prepared for rays");
  return std::move(*hit);
}

bool counts(const Ratio& t, const RaySegment& segment) {
  // −1 before a limit, 0 at it, 1 beyond it.
  const auto beside = [&](double limit) {
    return std::isinf(limit) ? (limit > 0 ? -1 : 1) : compare(t, Ratio(Dyadic(limit)));
  };
  const int from = beside(segment.t_min), to = beside(segment.t_max);
  return segment.open ? from > 0 && to < 0 : from >= 0 && to <= 0;
}

bool is_kept(Sign side, Cull cull) {
  return cull == Cull::none ||
         (cull == Cull::back ? side == Sign::negative : side == Sign::positive);
}

}  // namespace fathom::rays
