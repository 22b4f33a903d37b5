#include "fathom/evaluation/placed_points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

#include "fathom/evaluation/box_tree.h"
#include "fathom/evaluation/nearest_surface.h"
#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh_faces.h"
#include "fathom/text/counted.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

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

PlacedCloud::PlacedCloud(const Scene& scene, long power) : scene_(scene), power_(power) {
  const std::uint64_t count = point_count(scene);
  if (count > mesh::most_elements)
    throw InputError(text::counted(count, "point") + " are more than " +
                     std::to_string(mesh::most_elements));
  points_.resize(count);
  for (const Object& object : scene.objects) {
    const auto& vertices = scene.meshes[object.mesh].vertices;
    const std::uint64_t first = first_numbers_.back();
    first_numbers_.push_back(first + vertices.size());
    parallel_for(std::size_t{0}, vertices.size(),
                 [&](std::size_t i) { points_[first + i] = in_unit(object, vertices[i], power); });
  }
}

WorldPoint PlacedCloud::world(std::uint32_t number) const {
  const auto [object, vertex] = place_of(number);
  const Object& placed = scene_.objects[object];
  return to_world(placed, scene_.meshes[placed.mesh].vertices[vertex]);
}

bool PlacedCloud::are_same(std::uint32_t a, std::uint32_t b) const {
  if (points_[a] != points_[b]) return false;
  const WorldPoint p = world(a), q = world(b);
  return p.x == q.x && p.y == q.y && p.z == q.z;
}

void PlacedCloud::keep(std::vector<std::uint32_t> numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) points_[i] = points_[numbers[i]];
  points_.resize(numbers.size());
  points_.shrink_to_fit();
  kept_ = std::move(numbers);
}

PlacedCloud::Place PlacedCloud::place_of(std::uint32_t number) const {
  const std::uint64_t whole = kept_.empty() ? number : kept_[number];
  const auto next = std::upper_bound(first_numbers_.begin(), first_numbers_.end(), whole);
  const auto object = static_cast<std::size_t>(next - first_numbers_.begin()) - 1;
  return {object, static_cast<std::size_t>(whole - first_numbers_[object])};
}

std::uint64_t point_count(const Scene& scene) {
  std::uint64_t count = 0;
  for (const Object& object : scene.objects) {
    if (object.mesh >= scene.meshes.size()) throw InputError("scene: an object names no mesh");
    count += scene.meshes[object.mesh].vertices.size();
  }
  return count;
}

namespace {

/// The points that remain, by the cells of a grid, found by a hash of the cell: a list for each
/// value of the hash. Two cells may have the same value, which costs time only.
class RemainingPoints {
 public:
  RemainingPoints(const PlacedCloud& cloud, double density)
      : cloud_(cloud),
        density_(std::ldexp(density, static_cast<int>(-cloud.power()))),
        squared_density_(Dyadic(density) * Dyadic(density)),
        reach_(density_ + bounds::distance_error),
        cell_(2 * std::max(reach_, least_reach)),
        newest_(std::bit_ceil(std::size_t{cloud.count()}), none) {}

  /// Whether a point that remains is nearer to this one than the density.
  [[nodiscard]] bool are_near(std::uint32_t number) const {
    const Vector& p = cloud_[number];
    // Mostly one in the same cell is.
    if (are_near(number, place_of(cell_of(p)))) return true;
    Cell least = cell_of({p[0] - reach_, p[1] - reach_, p[2] - reach_});
    const Cell greatest = cell_of({p[0] + reach_, p[1] + reach_, p[2] + reach_});
    for (Cell c = least; c[0] <= greatest[0]; ++c[0])
      for (c[1] = least[1]; c[1] <= greatest[1]; ++c[1])
        for (c[2] = least[2]; c[2] <= greatest[2]; ++c[2])
          if (are_near(number, place_of(c))) return true;
    return false;
  }

  void add(std::uint32_t number) {
    std::uint32_t& newest = newest_[place_of(cell_of(cloud_[number]))];
    points_.push_back({cloud_[number], number, newest});
    newest = static_cast<std::uint32_t>(points_.size()) - 1;
  }

  [[nodiscard]] std::vector<std::uint32_t> numbers() const {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(points_.size());
    for (const Remaining& point : points_) numbers.push_back(point.number);
    return numbers;
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  /// Keeps numbers of cells far below 2⁶³: coordinates are below 1.
  static constexpr double least_reach = 0x1p-40;

  using Cell = std::array<std::int64_t, 3>;

  struct Remaining {
    Vector at;
    std::uint32_t number;
    /// The one before it of the same list, or none.
    std::uint32_t before;
  };

  [[nodiscard]] Cell cell_of(const Vector& p) const {
    Cell cell;
    for (std::size_t k = 0; k < 3; ++k)
      cell[k] = static_cast<std::int64_t>(std::floor(p[k] / cell_));
    return cell;
  }

  /// Source   [SLF14] for the multipliers and shifts
  [[nodiscard]] std::size_t place_of(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t k : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(k)) * 0xBF58476D1CE4E5B9U;
      hash = (hash ^ (hash >> 27U)) * 0x94D049BB133111EBU;
      hash ^= hash >> 31U;
    }
    return hash & (newest_.size() - 1);
  }

  [[nodiscard]] bool are_near(std::uint32_t number, std::size_t place) const {
    for (std::uint32_t i = newest_[place]; i != none; i = points_[i].before)
      if (are_near(number, points_[i])) return true;
    return false;
  }

  [[nodiscard]] bool are_near(std::uint32_t number, const Remaining& other) const {
    const double distance = length(minus(cloud_[number], other.at));
    if (distance + bounds::distance_error < density_) return true;
    if (distance - bounds::distance_error > density_) return false;
    return squared_distance(cloud_.world(number), cloud_.world(other.number)) < squared_density_;
  }

  const PlacedCloud& cloud_;
  double density_;
  Dyadic squared_density_;
  /// No point that is nearer than the density has a coordinate that differs by more.
  double reach_;
  double cell_;
  /// The last point of each list.
  std::vector<std::uint32_t> newest_;
  std::vector<Remaining> points_;
};

}  // namespace

std::vector<std::uint32_t> thinned(const PlacedCloud& cloud, double density) {
  RemainingPoints remaining(cloud, density);
  OccasionalInterruption interruption;
  for (std::uint32_t number = 0; number < cloud.count(); ++number) {
    interruption();
    if (!remaining.are_near(number)) remaining.add(number);
  }
  return remaining.numbers();
}

}  // namespace fathom::evaluation
