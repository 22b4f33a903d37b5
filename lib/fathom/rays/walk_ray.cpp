#include "fathom/rays/walk_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fathom/numeric/double_word.h"
#include "fathom/numeric/dyadic.h"
#include "fathom/numeric/interval.h"
#include "fathom/rays/ray_bounds.h"

namespace fathom::rays {
namespace {

/// x·2^power.
Interval scaled(double x, long power) {
  const auto exponent = static_cast<int>(power);
  const double value = std::ldexp(x, exponent);
  if (std::ldexp(value, -exponent) == x) return {value, value};
  return {std::nextafter(value, -infinity), std::nextafter(value, infinity)};
}

Interval difference(const Interval& a, const Interval& b) {
  const double lower = a.lower - b.upper, upper = a.upper - b.lower;
  if (a.lower == a.upper && std::isinf(a.lower)) return a;
  // An exact difference, for example of integers, remains a point.
  const WordPair low = two_sum(a.lower, -b.upper), high = two_sum(a.upper, -b.lower);
  return {low.lo == 0 && std::isfinite(lower) ? lower : std::nextafter(lower, -infinity),
          high.lo == 0 && std::isfinite(upper) ? upper : std::nextafter(upper, infinity)};
}

/// A moved origin beyond this belongs to a ray that misses the scene: it lies less than 3 from the
/// scene along its greatest component, and other coordinates change by no more on the way.
constexpr double greatest_moved = 5;
/// Up to here double-words move an origin.
constexpr double greatest_for_double_words = 0x1p40;

std::size_t steepest_axis(const Vector& direction) {
  std::size_t steepest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(direction[k]) > std::abs(direction[steepest])) steepest = k;
  return steepest;
}

/// Where the origin is moved to along its steepest axis: before the scene.
double goal(double slope) {
  return slope > 0 ? -near_scene : near_scene;
}

/// o + start·d. Products and sums of two are exact, so that an error below 2⁻⁶⁰ and the last
/// rounding remain.
void move(WalkRay& ray, std::size_t axis) {
  const double start = (goal(ray.direction[axis]) - ray.origin[axis]) / ray.direction[axis];
  for (std::size_t k = 0; k < 3; ++k) {
    const WordPair way = two_product<false>(start, ray.direction[k]);
    const WordPair sum = two_sum(ray.origin[k], way.hi);
    ray.origin[k] = sum.hi + (sum.lo + way.lo);
  }
  ray.start = {start, start};
}

/// The quotient to at least 2⁻⁵⁰ of itself.
Dyadic approximate_quotient(const Dyadic& x, double divisor) {
  if (x.is_zero()) return {};
  return Dyadic(enclose(x.scaled(-x.top())).lower / divisor).scaled(x.top());
}

/// The same in exact numbers, for origins of any size: step by step, as each step leaves 2⁻⁵⁰ of
/// the way.
void move_exactly(WalkRay& ray, std::size_t axis, const ExactVector3& origin,
                  const ExactVector3& direction) {
  const auto coordinate = [&](std::size_t k, const Dyadic& start) {
    return origin[k] + start * direction[k];
  };
  const Dyadic to(goal(ray.direction[axis]));
  Dyadic start;
  for (;;) {
    const Dyadic rest = to - coordinate(axis, start);
    if (abs(rest) < Dyadic(0.25)) break;
    start += approximate_quotient(rest, ray.direction[axis]);
  }
  for (std::size_t k = 0; k < 3; ++k) ray.origin[k] = enclose(coordinate(k, start)).lower;
  ray.start = enclose(start);
}

ExactVector3 scaled(const ExactVector3& v, long power) {
  return {v[0].scaled(power), v[1].scaled(power), v[2].scaled(power)};
}

/// Each component is rounded down.
Vector rounded(const ExactVector3& v) {
  return {enclose(v[0]).lower, enclose(v[1]).lower, enclose(v[2]).lower};
}

/// By how much rounded() changes a component below 2.
constexpr double rounding_below_2 = 0x1p-52;

/// k for which the greatest component of d/2^k is in [1, 2).
long power_of_direction(const ExactVector3& direction) {
  long greatest = std::numeric_limits<long>::min();
  for (const Dyadic& component : direction)
    if (!component.is_zero()) greatest = std::max(greatest, component.top());
  return greatest - 1;
}

double greatest_magnitude(const Vector& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

void set_slabs(WalkRay& ray) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double slope = ray.direction[k];
    const double room = ray.origin_error + bounds::parallel_room;
    // One step beyond the rounded sum, which may have lost the room.
    const float low = round_down(std::nextafter(ray.origin[k] - room, -infinity));
    const float high = round_up(std::nextafter(ray.origin[k] + room, infinity));
    ray.parallel[k] = std::abs(slope) < bounds::least_slope;
    ray.backward[k] = !ray.parallel[k] && slope < 0;
    ray.origin_near[k] = ray.backward[k] ? low : high;
    ray.origin_far[k] = ray.backward[k] ? high : low;
    if (ray.parallel[k]) continue;
    ray.inverse[k] = static_cast<float>(1 / slope);
    ray.inverse_far[k] = ray.inverse[k] * (1 + bounds::far_room);
  }
}

}  // namespace

Interval s_of(const WalkRay& ray, const Interval& t) {
  const Interval low = scaled(t.lower, -ray.scale), high = scaled(t.upper, -ray.scale);
  return difference({low.lower, high.upper}, ray.start);
}

bool set_stretch(WalkRay& ray, const RaySegment& segment) {
  ray.segment_first = s_of(ray, {segment.t_min, segment.t_min});
  ray.segment_last = s_of(ray, {segment.t_max, segment.t_max});
  if (ray.segment_last.upper < 0) return false;
  ray.first = std::max(0.0F, round_down(ray.segment_first.lower));
  ray.last = round_up(ray.segment_last.upper) * (1 + bounds::far_room);
  set_slabs(ray);
  return true;
}

long power_of_direction(const Ray& ray) {
  return std::ilogb(greatest_magnitude(ray.direction));
}

std::optional<WalkRay> prepare(const Ray& given, const RaySegment& segment, const RayTree& tree) {
  WalkRay ray;
  const long direction_power = power_of_direction(given);
  for (std::size_t k = 0; k < 3; ++k) {
    ray.origin[k] = std::ldexp(given.origin[k], static_cast<int>(-tree.power()));
    ray.direction[k] = std::ldexp(given.direction[k], static_cast<int>(-direction_power));
  }
  ray.scale = tree.power() - direction_power;

  const double size = greatest_magnitude(ray.origin);
  if (!(size <= near_scene && segment.t_min >= 0)) {
    const std::size_t axis = steepest_axis(ray.direction);
    if (size <= greatest_for_double_words) {
      move(ray, axis);
    } else {
      const ExactRay exact(given);
      move_exactly(ray, axis, scaled(exact.origin, -tree.power()),
                   scaled(exact.direction, -direction_power));
    }
    ray.origin_error = bounds::moved_origin_error;
    if (!(greatest_magnitude(ray.origin) <= greatest_moved)) return std::nullopt;
  }

  return set_stretch(ray, segment) ? std::optional(ray) : std::nullopt;
}

std::optional<WalkRay> prepare(const ExactRay& exact, const RaySegment& segment,
                               const RayTree& tree) {
  WalkRay ray;
  const long direction_power = power_of_direction(exact.direction);
  const ExactVector3 origin = scaled(exact.origin, -tree.power());
  const ExactVector3 direction = scaled(exact.direction, -direction_power);
  ray.origin = rounded(origin);
  ray.direction = rounded(direction);
  ray.direction_error = rounding_below_2;
  ray.scale = tree.power() - direction_power;
  double error = rounding_below_2;
  if (!(greatest_magnitude(ray.origin) <= near_scene && segment.t_min >= 0)) {
    move_exactly(ray, steepest_axis(ray.direction), origin, direction);
    error = bounds::moved_origin_error;
    if (!(greatest_magnitude(ray.origin) <= greatest_moved)) return std::nullopt;
  }
  ray.origin_error = error + bounds::longest_way * ray.direction_error;
  return set_stretch(ray, segment) ? std::optional(ray) : std::nullopt;
}

}  // namespace fathom::rays
