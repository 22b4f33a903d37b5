#include "fathom/rays/sight_line.h"

#include <algorithm>
#include <cmath>

#include "fathom/rays/ray_bounds.h"

namespace fathom::rays {
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
