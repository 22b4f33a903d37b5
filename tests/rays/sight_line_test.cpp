#include "fathom/rays/sight_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fathom/rays/ray_bounds.h"
#include "fathom/rays/ray_tree.h"
#include "tests/adversaries.h"
#include "tests/rays/sight_cases.h"

namespace fathom::rays {
namespace {

/// A line of sight in exact numbers, in the unit of a tree: from `from`, along `way` for each s.
struct ExactLine {
  ExactVector3 from, way;
};

ExactVector3 scaled(const ExactVector3& v, long power) {
  return {v[0].scaled(power), v[1].scaled(power), v[2].scaled(power)};
}

ExactLine line_of(const ExactRay& exact, const WalkRay& ray, long power) {
  return {scaled(exact.origin, -power), scaled(exact.direction, ray.scale - power)};
}

void expect_within(const Dyadic& a, const Dyadic& b, double error) {
  EXPECT_LE(abs(a - b), Dyadic(error));
}

/// That the errors of a ray whose origin was not moved are bounds; they grow evenly with s.
void expect_bounded(const WalkRay& ray, const ExactLine& line) {
  EXPECT_LE(ray.direction_error, bounds::greatest_direction_error);
  for (std::size_t k = 0; k < 3; ++k) {
    expect_within(ray.direction[k], line.way[k], ray.direction_error);
    for (const double s : {0.0, bounds::longest_way})
      expect_within(Dyadic(ray.origin[k]) + Dyadic(s) * Dyadic(ray.direction[k]),
                    line.from[k] + Dyadic(s) * line.way[k], ray.origin_error);
  }
}

/// The same of one that was moved to somewhere in `start`.
void expect_moved_within_bounds(const WalkRay& ray, const ExactLine& line) {
  for (std::size_t k = 0; k < 3; ++k) {
    expect_within(ray.direction[k], line.way[k], ray.direction_error);
    const double room = 2 * (ray.start.upper - ray.start.lower);
    expect_within(ray.origin[k], line.from[k] + Dyadic(ray.start.lower) * line.way[k],
                  ray.origin_error + room);
  }
}

void expect_end_bounded(const SightEnd& end, const WorldPoint& exact, long power) {
  const ExactVector3 place = scaled({exact.x, exact.y, exact.z}, -power);
  for (std::size_t k = 0; k < 3; ++k)
    if (end.near()[k].error < infinity)
      expect_within(end.near()[k].value, place[k], end.near()[k].error);
}

class SightLineAdversaries : public ::testing::TestWithParam<test::Family> {};

TEST_P(SightLineAdversaries, HaveErrorsWithinTheirBounds) {
  checks::for_each_adversary(60, [&](std::uint64_t seed) {
    const test::RayCase all = GetParam().draw(seed);
    const RayScene scene(all.scene);
    const TriangleSource& source = scene.triangles();
    const long power = scene.tree().power();
    for (const auto& [eye, point] : test::draw_pairs(all, seed)) {
      SCOPED_TRACE(test::text_of(eye) + " to " + test::text_of(point));
      const SightEnd from(eye, source, power), to(point, source, power);
      const ExactRay exact = ray_between(from.exact(source), to.exact(source));
      expect_end_bounded(from, from.exact(source), power);
      if (std::ranges::all_of(exact.direction, &Dyadic::is_zero)) continue;
      if (const auto ray = prepare_between(from.near(), to.near()))
        expect_bounded(*ray, line_of(exact, *ray, power));
      const auto ray = prepare(exact, {.t_min = 0, .t_max = 1}, scene.tree());
      if (!ray || !std::isfinite(ray->start.lower) || !std::isfinite(ray->start.upper)) continue;
      const ExactLine line = line_of(exact, *ray, power);
      if (ray->start.lower == 0 && ray->start.upper == 0) {
        expect_bounded(*ray, line);
      } else {
        expect_moved_within_bounds(*ray, line);
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Families, SightLineAdversaries, ::testing::ValuesIn(test::families()),
                         [](const auto& family) { return family.param.name; });

}  // namespace
}  // namespace fathom::rays
