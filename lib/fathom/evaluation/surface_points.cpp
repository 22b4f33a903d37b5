#include "fathom/evaluation/surface_points.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fathom/failures/errors.h"

namespace fathom::evaluation {
namespace {

double area(const PlacedTriangles::Corners& corners) {
  Vector ab, ac;
  for (std::size_t k = 0; k < 3; ++k) {
    ab[k] = corners[1][k] - corners[0][k];
    ac[k] = corners[2][k] - corners[0][k];
  }
  return std::hypot(ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2],
                    ab[0] * ac[1] - ab[1] * ac[0]) /
         2;
}

/// The point of the unit square that the R₂ sequence has at `index`, in the middle of a cell of a
/// grid of 2²⁴: multiples of 2⁻²⁵. 1/g and 1/g² with g³ = g + 1 are rounded to 32 bits; unsigned
/// numbers count modulo 1.
std::pair<double, double> r2_point(std::uint32_t index) {
  constexpr std::uint32_t half = 0x80000000U, first = 3242174889U, second = 2447445414U;
  const auto coordinate = [&](std::uint32_t step) {
    return (static_cast<double>((half + index * step) >> 8U) + 0.5) * 0x1p-24;
  };
  return {coordinate(first), coordinate(second)};
}

}  // namespace

std::vector<SurfacePoint> surface_points(const PlacedTriangles& triangles, std::uint32_t count) {
  std::vector<double> up_to(triangles.count());
  double sum = 0;
  for (std::uint32_t t = 0; t < triangles.count(); ++t) up_to[t] = sum += area(triangles[t]);
  if (!(sum > 0)) throw InputError("the surface has no area");
  std::vector<SurfacePoint> points(count);
  std::uint32_t triangle = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double place = (i + 0.5) / count * sum;
    while (triangle + 1 < triangles.count() && up_to[triangle] <= place) ++triangle;
    auto [u, v] = r2_point(i);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    points[i] = {triangle, u, v};
  }
  return points;
}

PlacedPoint placed(const SurfacePoint& point, const TriangleSource& source,
                   const PlacedTriangles& triangles) {
  const std::array<WorldPoint, 3> world = source.world_corners(point.triangle);
  const Dyadic v(point.v), w(point.w);
  const auto exact = [&](Dyadic WorldPoint::*k) {
    return world[0].*k + v * (world[1].*k - world[0].*k) + w * (world[2].*k - world[0].*k);
  };
  PlacedPoint result{{exact(&WorldPoint::x), exact(&WorldPoint::y), exact(&WorldPoint::z)}, {}};
  const PlacedTriangles::Corners& near = triangles[point.triangle];
  for (std::size_t k = 0; k < 3; ++k) {
    result.near[k] =
        near[0][k] + point.v * (near[1][k] - near[0][k]) + point.w * (near[2][k] - near[0][k]);
  }
  return result;
}

}  // namespace fathom::evaluation
