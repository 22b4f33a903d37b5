#include "fathom/rays/sight_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/rays/placed_triangles.h"
#include "fathom/rays/ray_bounds.h"

namespace fathom::rays {
namespace {

CertifiedVector near_of(const std::array<double, 3>& p, const TriangleSource&, long power) {
  return {number_in_unit(p[0], power), number_in_unit(p[1], power), number_in_unit(p[2], power)};
}

CertifiedVector near_of(const SurfacePoint& p, const TriangleSource& source, long power) {
  const auto [a, b, c] = corners_in_unit(source, p.triangle, power);
  const CertifiedNumber v{p.v, 0}, w{p.w, 0};
  CertifiedVector near;
  for (std::size_t k = 0; k < 3; ++k)
    near[k] = a[k] + v * minus(b[k], a[k]) + w * minus(c[k], a[k]);
  return near;
}

WorldPoint exact_of(const std::array<double, 3>& p, const TriangleSource&) {
  return {p[0], p[1], p[2]};
}

WorldPoint exact_of(const SurfacePoint& p, const TriangleSource& source) {
  const std::array<WorldPoint, 3> corners = source.world_corners(p.triangle);
  const Dyadic v(p.v), w(p.w);
  const auto coordinate = [&](Dyadic WorldPoint::*k) {
    const Dyadic& a = corners[0].*k;
    return a + v * (corners[1].*k - a) + w * (corners[2].*k - a);
  };
  return {coordinate(&WorldPoint::x), coordinate(&WorldPoint::y), coordinate(&WorldPoint::z)};
}

}  // namespace

CertifiedNumber minus(const CertifiedNumber& a, const CertifiedNumber& b) {
  return a + CertifiedNumber{-b.value, b.error};
}

CertifiedNumber number_in_unit(double x, long power) {
  const double value = std::ldexp(x, static_cast<int>(-power));
  if (std::isinf(value)) return {value, std::numeric_limits<double>::infinity()};
  return {value, std::ldexp(value, static_cast<int>(power)) == x ? 0 : most_underflow};
}

std::array<CertifiedVector, 3> corners_in_unit(const TriangleSource& source, std::uint32_t triangle,
                                               long power) {
  const TriangleSource::Triangle t = source.triangle(triangle);
  const Object& object = source.objects()[t.origin.object];
  std::array<CertifiedVector, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const MeshPoint& p = t.corners[i];
    if (object.placed_as_is) {
      corners[i] = near_of(std::array{p.x, p.y, p.z}, source, power);
    } else {
      const Vector near = in_unit(object, p, power);
      for (std::size_t k = 0; k < 3; ++k) corners[i][k] = {near[k], placing_error};
    }
  }
  return corners;
}

SightEnd::SightEnd(const SightPoint& point, const TriangleSource& source, long power)
    : point_(point),
      near_(std::visit([&](const auto& p) { return near_of(p, source, power); }, point)) {}

WorldPoint SightEnd::exact(const TriangleSource& source) const {
  return std::visit([&](const auto& p) { return exact_of(p, source); }, point_);
}

std::uint32_t SightEnd::triangle() const {
  const auto* const on_surface = std::get_if<SurfacePoint>(&point_);
  return on_surface ? on_surface->triangle : no_triangle;
}

namespace {

/// False for NaN, too.
bool is_near_scene(const CertifiedVector& p) {
  return std::ranges::all_of(p, [](const CertifiedNumber& x) {
    return std::abs(x.value) <= near_scene && x.error <= bounds::greatest_origin_error;
  });
}

}  // namespace

// With the exact ends P and Q the direction is (Q − P)/2^k, exactly, and s = 2^k at Q.
std::optional<WalkRay> prepare_between(const CertifiedVector& from, const CertifiedVector& to) {
  if (!is_near_scene(from)) return std::nullopt;
  WalkRay ray;
  double greatest = 0, error_of_origin = 0, error_of_way = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const CertifiedNumber way = minus(to[k], from[k]);
    if (!std::isfinite(way.value) || !std::isfinite(way.error)) return std::nullopt;
    ray.origin[k] = from[k].value;
    ray.direction[k] = way.value;
    greatest = std::max(greatest, std::abs(way.value));
    error_of_origin = std::max(error_of_origin, from[k].error);
    error_of_way = std::max(error_of_way, way.error);
  }
  if (!(4 * error_of_way <= greatest * bounds::greatest_direction_error)) return std::nullopt;
  const int power = std::ilogb(greatest);
  for (double& component : ray.direction) component = std::ldexp(component, -power);
  // Less than twice the quotient, whatever underflows.
  ray.direction_error = 2 * std::max(std::ldexp(error_of_way, -power), most_underflow);
  ray.origin_error = (error_of_origin + bounds::longest_way * ray.direction_error) * bounds::slack;
  ray.scale = -power;
  return set_stretch(ray, {.t_min = 0, .t_max = 1}) ? std::optional(ray) : std::nullopt;
}

}  // namespace fathom::rays
