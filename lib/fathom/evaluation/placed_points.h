#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fathom/evaluation/box_tree.h"
#include "fathom/geometry/frames.h"
#include "fathom/rays/sight.h"
#include "fathom/scene/scene.h"

/// The points that distances are measured from: of a surface, and of a cloud.
namespace fathom::evaluation {

/// `count` points of a surface, as many on one part as on another of the same area, without chance:
/// they stand at equal distances in the running sum of the triangles' areas, and within their
/// triangles where the R₂ sequence puts them. Weights are at least 0, with a sum of at most 1, and
/// multiples of 2⁻²⁵. They depend on the surface and `count` only.
/// Exact    a point is on its triangle; the areas by which they are dealt out are rounded
/// Fails    InputError if the area of the triangles is 0 in binary64
/// Source   [Rob18]
std::vector<SurfacePoint> surface_points(const PlacedTriangles& triangles, std::uint32_t count);

/// A point in the world, and in the unit of the triangles, where each coordinate is within
/// bounds::point_error of the exact one.
struct PlacedPoint {
  WorldPoint exact;
  Vector near;
};
PlacedPoint placed(const SurfacePoint& point, const TriangleSource& source,
                   const PlacedTriangles& triangles);

/// The vertices of all objects of a scene, as points in the world: exactly, and in binary64 in a
/// unit in which all coordinates are below 1, each within bounds::corner_error of the exact one.
/// The scene must outlive it.
class PlacedCloud {
 public:
  /// The unit is 2 to the power of `power`, at least power_of_unit().
  /// Fails    InputError for more points than can be numbered.
  PlacedCloud(const Scene& scene, long power);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(points_.size()); }
  [[nodiscard]] const Vector& operator[](std::uint32_t number) const { return points_[number]; }
  [[nodiscard]] WorldPoint world(std::uint32_t number) const;
  [[nodiscard]] long power() const { return power_; }
  /// Whether two points are equal exactly.
  [[nodiscard]] bool are_same(std::uint32_t a, std::uint32_t b) const;

  /// Keeps only the points of these numbers, which are in ascending order, and renumbers them. May
  /// be called once.
  void keep(std::vector<std::uint32_t> numbers);

 private:
  /// A point as the scene has it.
  struct Place {
    std::size_t object, vertex;
  };
  [[nodiscard]] Place place_of(std::uint32_t number) const;

  const Scene& scene_;
  long power_;
  std::vector<Vector> points_;
  /// Which of all the scene's points are kept; empty for all.
  std::vector<std::uint32_t> kept_;
  /// Among all the scene's points the first of each object, and their number.
  std::vector<std::uint64_t> first_numbers_{0};
};

/// The number of vertices of all objects.
/// Fails    InputError if an object names no mesh.
std::uint64_t point_count(const Scene& scene);

/// The points that remain of a cloud that is thinned: in its order, each point that is not nearer
/// than `density`, in scene units, to a point kept before.
/// Exact    every decision: by binary64 with bounds, and by exact numbers where these leave it open
std::vector<std::uint32_t> thinned(const PlacedCloud& cloud, double density);

}  // namespace fathom::evaluation
