#include "fathom/attribution/ray/ray_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/attribution/model/own_roundings.h"
#include "fathom/numeric/unit_roundoff.h"

// docs/validation.md, "A ray tracer", derives what stands here, in the same order.
namespace fathom::attribution {
namespace {

constexpr double u = unit_roundoff<float>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A triangle seen from the ray's origin.
struct Seen {
  /// Corners from the origin, and how far the renderer's own are off.
  std::array<Vector3, 3> corners, held;
  Vector3 e1, e2, normal;
  /// N·d, and the sum of the bounds of the edge tests.
  double facing = 0, facing_error = 0;
};

Seen seen_from(const Ray& ray, const std::array<Vector3, 3>& corners) {
  Seen seen;
  for (std::size_t i = 0; i < 3; ++i) {
    seen.corners[i] = corners[i] - ray.origin;
    seen.held[i] = u * abs(corners[i]) + ray.origin_error + u * abs(seen.corners[i]);
  }
  seen.e1 = seen.corners[1] - seen.corners[0];
  seen.e2 = seen.corners[2] - seen.corners[0];
  seen.normal = seen.e1.cross(seen.e2);
  seen.facing = seen.normal.dot(ray.direction);
  return seen;
}

/// The volumes of two corners and the ray, one for each edge, and their bounds without what they
/// have in common: `rounded`, the roundings of all three. Each in whichever way it is computed, by
/// differences with one corner or by sums of two, takes no more than the model's roundings of these
/// products.
struct EdgeTests {
  std::array<double, 3> volume{}, error{};
  double rounded = 0;
};

EdgeTests edge_tests(const Seen& seen, const Ray& ray, const RayModel& model) {
  const auto& a = seen.corners;
  const auto& held = seen.held;
  const Vector3& d = ray.direction;
  EdgeTests tests;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    tests.volume[k] = a[i].cross(a[j]).dot(d);
    tests.error[k] = abs(a[i].cross(a[j])).dot(ray.direction_error) +
                     held[i].dot(abs(a[j].cross(d))) + held[j].dot(abs(d.cross(a[i]))) +
                     2 * (permanent(held[i], held[j], abs(d) + ray.direction_error));
    tests.rounded += model.roundings * u *
                     permanent(a[j] - a[i], abs(a[i]) + abs(a[j]), abs(d) + ray.direction_error);
  }
  return tests;
}

/// Coverage, open edges and inside; nothing where the ray is certain to pass by.
std::optional<Fragment> covered(Seen& seen, const Ray& ray, const RayModel& model) {
  const EdgeTests tests = edge_tests(seen, ray, model);
  const bool turned = seen.facing < 0;
  Fragment f{.coverage = Coverage::must, .turned = turned, .inside = true};
  bool one_way = true, other_way = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const double bound = own_roundings * (tests.error[k] + tests.rounded);
    seen.facing_error += bound;
    one_way = one_way && tests.volume[k] + bound >= 0;
    other_way = other_way && tests.volume[k] - bound <= 0;
    const double inward = turned ? -tests.volume[k] : tests.volume[k];
    if (inward < 0) f.inside = false;
    if (!(inward > bound)) {
      f.coverage = Coverage::may;
      f.open_edges |= static_cast<std::uint8_t>(1U << k);
    }
  }
  if (!one_way && !other_way) return std::nullopt;
  return f;
}

/// The distance: N·(corner − origin) / N·d, of a plane whose corners are displaced.
void set_value(Fragment& f, const Seen& seen, const Ray& ray, const ModelRays& rays,
               const RayModel& model) {
  const auto& [a, held, e1, e2, normal, facing, facing_error] = seen;
  const double t = normal.dot(a[0]) / facing;
  const double rest = std::abs(facing) - facing_error;
  const Vector3 displaced = held[0].cwiseMax(held[1]).cwiseMax(held[2]);
  const Vector3 spread = displaced + std::abs(t) * ray.direction_error;
  const double plane_error =
      model.roundings * u *
      (permanent(e1, e2, a[0]) + std::abs(t) * permanent(e1, e2, ray.direction));
  // Weights of a sample that an open edge lets in may be negative, by the edges' bounds in all.
  const double outside = 1 + 2 * facing_error / rest;
  double half = own_roundings * outside * (abs(normal).dot(spread) + plane_error) / rest;
  if (!(rest > 0) || !std::isfinite(t)) {
    f.coverage = Coverage::may;
    half = infinity;
  }
  half += 2 * u * std::abs(t);
  if (model.depth_from_point) half += rays.depth_error(ray, t);
  if (std::isnan(half)) half = infinity;
  f.exact = std::isfinite(t) ? t : 0;
  f.value = {f.exact - half, f.exact + half};
}

}  // namespace

std::optional<Fragment> ray_on_triangle(const std::array<Vector3, 3>& corners, const Ray& ray,
                                        const ModelRays& rays, const RayModel& model) {
  Seen seen = seen_from(ray, corners);
  std::optional<Fragment> f = covered(seen, ray, model);
  if (!f) return std::nullopt;
  set_value(*f, seen, ray, rays, model);
  const Camera& camera = rays.camera();
  if (f->value.upper <= 0 || f->value.upper < camera.near || f->value.lower > camera.far) {
    return std::nullopt;
  }
  if (f->value.lower <= 0 || f->value.lower < camera.near || f->value.upper > camera.far) {
    f->coverage = Coverage::may;
    f->open_edges = joins_no_other;
  }
  return f;
}

}  // namespace fathom::attribution
