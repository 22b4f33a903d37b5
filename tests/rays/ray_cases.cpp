#include "tests/rays/ray_cases.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "fathom/scene/triangle_source.h"
#include "tests/inputs/scene_building.h"
#include "tests/rays/voxel_solids.h"

namespace fathom::rays::test {
namespace {

using Random = std::mt19937_64;
using Point = std::array<double, 3>;
using Coordinate = std::function<double(Random&)>;

int from(Random& random, int least, int greatest) {
  return least + static_cast<int>(random() % static_cast<std::uint64_t>(greatest - least + 1));
}
double whole(Random& random) {
  return from(random, -4, 4);
}
double uniform(Random& random) {
  return std::uniform_real_distribution(-1.0, 1.0)(random);
}

Point some_point(Random& random, const Coordinate& coordinate) {
  const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
  return {x, y, z};
}

/// Triangles that share vertices; now and then one without area.
Scene soup(Random& random, int triangles, const Coordinate& coordinate) {
  std::vector<MeshPoint> vertices;
  for (int i = 0; i < triangles + 2; ++i) {
    const Point p = some_point(random, coordinate);
    vertices.push_back({p[0], p[1], p[2]});
  }
  std::vector<CornerIndices> list;
  const auto index = [&] { return static_cast<std::uint32_t>(random() % vertices.size()); };
  for (int i = 0; i < triangles; ++i) {
    const std::uint32_t a = index(), b = index(), c = index();
    list.push_back({a, b, c});
  }
  return checks::scene_of(std::move(vertices), std::move(list));
}

Point to_array(const MeshPoint& p) {
  return {p.x, p.y, p.z};
}
Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Point scaled(const Point& p, double factor) {
  return {p[0] * factor, p[1] * factor, p[2] * factor};
}
Point middle(const Point& a, const Point& b) {
  return {a[0] / 2 + b[0] / 2, a[1] / 2 + b[1] / 2, a[2] / 2 + b[2] / 2};
}

/// A corner, a point of an edge, or a point within a triangle of the first object.
Point some_target(Random& random, const Scene& scene) {
  const Mesh& mesh = scene.meshes[0];
  const CornerIndices& t = mesh.triangles[random() % mesh.triangles.size()];
  const Point a = to_array(mesh.vertices[t[0]]), b = to_array(mesh.vertices[t[1]]),
              c = to_array(mesh.vertices[t[2]]);
  switch (random() % 3) {
    case 0:
      return a;
    case 1:
      return middle(a, b);
    default:
      return middle(middle(a, b), c);
  }
}

/// A ray that is not one of direction 0, on its way from a point to another, or one beside it.
Ray aimed(Random& random, const Point& origin, const Point& target, bool beside) {
  Point d = minus(target, origin);
  if (beside) {
    double& component = d[random() % 3];
    component = std::nextafter(component, random() % 2 == 0 ? 8.0 : -8.0);
  }
  if (d == Point{}) d = {0, 1, 0};
  return {origin, d};
}

void aim(RayCase& to, Random& random, int count, const Coordinate& coordinate, bool beside) {
  for (int i = 0; i < count; ++i) {
    const Point origin = some_point(random, coordinate);
    to.rays.push_back(
        aimed(random, origin, some_target(random, to.scene), beside && random() % 2 == 0));
  }
}

RayCase random_rays(std::uint64_t seed) {
  Random random(seed);
  RayCase all{soup(random, from(random, 1, 40), uniform), {}, {}};
  for (int i = 0; i < 20; ++i) {
    const Point origin = some_point(random, uniform);
    all.rays.push_back({origin, some_point(random, uniform)});
  }
  return all;
}

RayCase at_corners_of_grid(std::uint64_t seed) {
  Random random(seed);
  RayCase all{soup(random, from(random, 1, 40), whole), {}, {}};
  aim(all, random, 20, whole, false);
  return all;
}

RayCase beside_corners(std::uint64_t seed) {
  Random random(seed);
  RayCase all{soup(random, from(random, 1, 40), uniform), {}, {}};
  aim(all, random, 20, uniform, true);
  return all;
}

/// Rays from a triangle's plane along it.
RayCase in_planes(std::uint64_t seed) {
  Random random(seed);
  RayCase all{soup(random, from(random, 1, 20), whole), {}, {}};
  const Mesh& mesh = all.scene.meshes[0];
  for (int i = 0; i < 20; ++i) {
    const CornerIndices& t = mesh.triangles[random() % mesh.triangles.size()];
    const Point a = to_array(mesh.vertices[t[0]]), b = to_array(mesh.vertices[t[1]]),
                c = to_array(mesh.vertices[t[2]]);
    const double along = from(random, -3, 3), across = from(random, -3, 3);
    const Point p = minus(b, a), r = minus(c, a);
    Point d, origin;
    for (std::size_t k = 0; k < 3; ++k) {
      d[k] = along * p[k] + across * r[k];
      origin[k] = a[k] + from(random, -2, 2) * d[k] + (random() % 3 == 0 ? p[k] : 0);
    }
    all.rays.push_back(aimed(random, origin, {origin[0] + d[0], origin[1] + d[1], origin[2] + d[2]},
                             random() % 4 == 0));
  }
  return all;
}

/// Corners on few lines: most triangles have no area or are very thin.
RayCase at_needles(std::uint64_t seed) {
  Random random(seed);
  const auto on_line = [](Random& r) { return r() % 4 == 0 ? 1 + uniform(r) * 0x1p-50 : 1.0; };
  std::vector<MeshPoint> vertices;
  for (int i = 0; i < 12; ++i) {
    const double x = whole(random);
    vertices.push_back({x, x * on_line(random), random() % 2 == 0 ? x : on_line(random)});
  }
  std::vector<CornerIndices> list;
  for (int i = 0; i < 30; ++i) {
    const auto a = static_cast<std::uint32_t>(random() % 12),
               b = static_cast<std::uint32_t>(random() % 12),
               c = static_cast<std::uint32_t>(random() % 12);
    list.push_back({a, b, c});
  }
  RayCase all{checks::scene_of(std::move(vertices), std::move(list)), {}, {}};
  aim(all, random, 20, whole, true);
  return all;
}

/// Everything times a power of two at the ends of the range.
RayCase out_of_proportion(std::uint64_t seed) {
  Random random(seed);
  RayCase all = seed % 2 == 0 ? at_corners_of_grid(seed) : beside_corners(seed);
  const double of_scene = std::ldexp(1.0, from(random, -1040, 1020));
  for (MeshPoint& p : all.scene.meshes[0].vertices)
    p = {p.x * of_scene, p.y * of_scene, p.z * of_scene};
  for (Ray& ray : all.rays) {
    ray.origin = scaled(ray.origin, of_scene);
    Point d = scaled(ray.direction, std::ldexp(1.0, from(random, -1060, 1020)));
    if (d != Point{}) ray.direction = d;
  }
  return all;
}

/// Coordinates from subnormal numbers to the greatest in one scene.
RayCase of_all_magnitudes(std::uint64_t seed) {
  Random random(seed);
  const int least = seed % 2 == 0 ? -1070 : -60, greatest = seed % 2 == 0 ? 1000 : 60;
  const auto coordinate = [=](Random& r) {
    return r() % 5 == 0 ? 0.0 : std::ldexp(uniform(r), from(r, least, greatest));
  };
  RayCase all{soup(random, from(random, 1, 30), coordinate), {}, {}};
  aim(all, random, 20, coordinate, true);
  std::erase_if(all.rays, [](const Ray& ray) {
    return !std::ranges::all_of(ray.direction, [](double x) { return std::isfinite(x); });
  });
  return all;
}

RayCase from_surfaces(std::uint64_t seed) {
  Random random(seed);
  RayCase all{soup(random, from(random, 2, 30), whole), {}, {}};
  for (int i = 0; i < 20; ++i) {
    const Point origin = some_target(random, all.scene);
    all.rays.push_back(aimed(random, origin, some_target(random, all.scene), random() % 4 == 0));
  }
  all.options.segment.open = seed % 2 == 0;
  return all;
}

/// Along the axes, with zeros of both signs.
RayCase along_axes(std::uint64_t seed) {
  Random random(seed);
  const Coordinate coordinate = seed % 2 == 0 ? Coordinate(whole) : Coordinate(uniform);
  RayCase all{soup(random, from(random, 1, 30), coordinate), {}, {}};
  for (int i = 0; i < 20; ++i) {
    Point d{0.0, -0.0, random() % 2 == 0 ? 0.0 : -0.0};
    d[random() % 3] = random() % 2 == 0 ? 1 : -3;
    if (random() % 4 == 0) d[random() % 3] = std::ldexp(uniform(random), from(random, -1074, -30));
    if (d == Point{}) d[0] = 1;
    Point origin = some_target(random, all.scene);
    const double back = from(random, -9, 2);
    for (std::size_t k = 0; k < 3; ++k) origin[k] += back * d[k];
    all.rays.push_back({origin, d});
  }
  return all;
}

/// Segments that begin and end on surfaces, or anywhere; the whole line; culling.
RayCase on_segments(std::uint64_t seed) {
  Random random(seed);
  RayCase all = seed % 3 == 0 ? beside_corners(seed) : at_corners_of_grid(seed);
  RaySegment& segment = all.options.segment;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  switch (random() % 4) {
    case 0:
      segment = {-infinity, infinity, false};
      break;
    case 1:
      segment = {0, 1, random() % 2 == 0};
      break;
    case 2:
      segment = {-1, 0.5 * from(random, 0, 3), random() % 2 == 0};
      break;
    default:
      segment.t_min = uniform(random);
      segment.t_max = segment.t_min + 1 + uniform(random);
  }
  constexpr std::array culls{Cull::none, Cull::back, Cull::front};
  all.options.cull = culls[random() % 3];
  return all;
}

/// The object placed by a matrix whose products with corners need more than 53 bits.
Object placed_anyhow(Random& random, Object object, double step) {
  object.placed_as_is = false;
  for (auto& row : object.world_from_mesh.rows)
    for (Dyadic& entry : row) entry = step * whole(random);
  return object;
}

RayCase placed(std::uint64_t seed) {
  Random random(seed);
  RayCase all = beside_corners(seed);
  const Object first = all.scene.objects[0];
  for (int i = 0; i < from(random, 1, 3); ++i)
    all.scene.objects.push_back(placed_anyhow(random, first, seed % 2 == 0 ? 1 : 1.0 / 3));
  return all;
}

RayCase from_afar(std::uint64_t seed) {
  Random random(seed);
  RayCase all{soup(random, from(random, 1, 30), seed % 2 == 0 ? whole : uniform), {}, {}};
  for (int i = 0; i < 20; ++i) {
    const Point far_away = scaled(some_point(random, whole),
                                  std::ldexp(1.0, from(random, 0, seed % 3 == 0 ? 900 : 45)));
    all.rays.push_back(aimed(random, far_away, some_target(random, all.scene), false));
    if (random() % 3 == 0) all.options.segment.t_min = -2;
  }
  return all;
}

/// A corner in the world, each coordinate rounded.
Point some_world_corner(Random& random, const Scene& scene) {
  const TriangleSource source(scene);
  const auto corners = source.world_corners(static_cast<std::uint32_t>(random() % source.count()));
  const WorldPoint& p = corners[random() % 3];
  return {enclose(p.x).lower, enclose(p.y).lower, enclose(p.z).lower};
}

/// Triangles of a few units of the last place: what a corner or a moved origin loses by rounding is
/// as large as they are.
RayCase at_tiny_triangles(std::uint64_t seed) {
  Random random(seed);
  const double unit = std::ldexp(1.0, from(random, -53, -44));
  Point base = some_point(random, uniform);
  base[random() % 3] = 0.75;
  std::size_t axis = 0;
  const auto beside_base = [&](Random& r) { return base[axis++ % 3] + unit * from(r, -9, 9); };
  RayCase all{soup(random, from(random, 1, 20), beside_base), {}, {}};
  if (seed % 2 == 0) all.scene.objects = {placed_anyhow(random, all.scene.objects[0], 1.0 / 3)};
  const double distance = std::ldexp(1.0, from(random, 2, 30));
  for (int i = 0; i < 40; ++i) {
    Point origin = scaled(some_point(random, uniform), distance);
    if (seed % 4 < 3) {  // among them
      origin = some_world_corner(random, all.scene);
      const double step = std::ldexp(unit, from(random, 0, 16));
      for (double& x : origin) x += step * whole(random);
    }
    all.rays.push_back(aimed(random, origin, some_world_corner(random, all.scene), false));
  }
  return all;
}

RayCase at_voxels(std::uint64_t seed) {
  return {voxel_solid(seed), rays_at_voxels(seed, 20), {}};
}

}  // namespace

const std::vector<Family>& families() {
  static const std::vector<Family> all{
      {"RandomRays", random_rays},
      {"AtCornersOfGrid", at_corners_of_grid},
      {"BesideCorners", beside_corners},
      {"InPlanes", in_planes},
      {"AtNeedles", at_needles},
      {"OutOfProportion", out_of_proportion},
      {"OfAllMagnitudes", of_all_magnitudes},
      {"FromSurfaces", from_surfaces},
      {"AlongAxes", along_axes},
      {"OnSegments", on_segments},
      {"Placed", placed},
      {"FromAfar", from_afar},
      {"AtTinyTriangles", at_tiny_triangles},
      {"AtVoxels", at_voxels},
  };
  return all;
}

}  // namespace fathom::rays::test
