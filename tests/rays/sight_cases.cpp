#include "tests/rays/sight_cases.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "fathom/scene/triangle_source.h"
#include "tests/oracle/generic_rays.h"
#include "tests/oracle/sight.h"

namespace fathom::rays::test {
namespace {

using Random = std::mt19937_64;
using Point = std::array<double, 3>;

bool is_finite(const Point& p) {
  return std::ranges::all_of(p, [](double x) { return std::isfinite(x); });
}

Point rounded_corner(Random& random, const TriangleSource& source, std::uint32_t triangle) {
  const WorldPoint p = source.world_corners(triangle)[random() % 3];
  return {enclose(p.x).lower, enclose(p.y).lower, enclose(p.z).lower};
}

Point on_ray(Random& random, const RayCase& from) {
  const Ray& ray = from.rays[random() % from.rays.size()];
  if (random() % 2 == 0) return ray.origin;
  Point p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = ray.origin[k] + ray.direction[k];
  return is_finite(p) ? p : ray.origin;
}

/// Corners, points of edges, of the triangle, and now and then of its plane.
SurfacePoint on_triangle(Random& random, std::uint32_t triangle) {
  const double part = static_cast<double>(random() % 9) / 8;
  const double any = std::uniform_real_distribution(0.0, 1.0)(random);
  switch (random() % 6) {
    case 0:
      return {triangle, part, 0};
    case 1:
      return {triangle, 0, part};
    case 2:
      return {triangle, part, 1 - part};
    case 3:
      return {triangle, any, (1 - any) * part};
    case 4:
      return {triangle, 0x1p-1074, any * 0x1p-60};
    default:
      return {triangle, random() % 4 == 0 ? 0x1p70 : 3, -any};
  }
}

SightPoint some_end(Random& random, const RayCase& from, const TriangleSource& source) {
  const auto triangle = static_cast<std::uint32_t>(random() % source.count());
  switch (random() % 4) {
    case 0:
      return on_ray(random, from);
    case 1:
      return rounded_corner(random, source, triangle);
    default:
      return on_triangle(random, triangle);
  }
}

}  // namespace

std::vector<std::pair<SightPoint, SightPoint>> draw_pairs(const RayCase& from, std::uint64_t seed) {
  Random random(seed + 77);
  const TriangleSource source(from.scene);
  std::vector<std::pair<SightPoint, SightPoint>> pairs;
  for (int i = 0; i < 30; ++i) {
    const SightPoint eye = some_end(random, from, source);
    pairs.emplace_back(eye, random() % 20 == 0 ? eye : some_end(random, from, source));
  }
  return pairs;
}

oracle::Vector rational_point(const SightPoint& point, const std::vector<oracle::Triangle>& all) {
  if (const auto* const place = std::get_if<Point>(&point)) return oracle::exact_vector(*place);
  const auto& on_surface = std::get<SurfacePoint>(point);
  return oracle::point_of(all[on_surface.triangle], oracle::Q(on_surface.v),
                          oracle::Q(on_surface.w));
}

std::string text_of(const SightPoint& point) {
  char text[128];
  if (const auto* const p = std::get_if<Point>(&point)) {
    std::snprintf(text, sizeof text, "Point{%a, %a, %a}", (*p)[0], (*p)[1], (*p)[2]);
  } else {
    const auto& on_surface = std::get<SurfacePoint>(point);
    std::snprintf(text, sizeof text, "SurfacePoint{%u, %a, %a}", on_surface.triangle, on_surface.v,
                  on_surface.w);
  }
  return text;
}

}  // namespace fathom::rays::test
