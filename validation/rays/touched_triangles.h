#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "fathom/attribution/model/renderer_input.h"
#include "fathom/rays/ray.h"

/// Triangles with their edges, as rays touch them: by CGAL's exact predicates and rational numbers,
/// which share nothing with Fathom's.
namespace fathom::validation {

template <class Kernel>
typename Kernel::Point_3 point_of(const std::array<double, 3>& p) {
  return {p[0], p[1], p[2]};
}

template <class Kernel>
std::vector<typename Kernel::Triangle_3> triangles_of(const attribution::WorldMesh& mesh) {
  std::vector<typename Kernel::Triangle_3> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const CornerIndices& triangle : mesh.triangles) {
    triangles.emplace_back(point_of<Kernel>(mesh.points[triangle[0]]),
                           point_of<Kernel>(mesh.points[triangle[1]]),
                           point_of<Kernel>(mesh.points[triangle[2]]));
  }
  return triangles;
}

template <class Kernel>
typename Kernel::Ray_3 ray_of(const Ray& ray) {
  const auto& d = ray.direction;
  return {point_of<Kernel>(ray.origin), typename Kernel::Vector_3(d[0], d[1], d[2])};
}

class TouchedTriangles {
 public:
  explicit TouchedTriangles(const attribution::WorldMesh& mesh);
  ~TouchedTriangles();
  TouchedTriangles(const TouchedTriangles&) = delete;
  TouchedTriangles& operator=(const TouchedTriangles&) = delete;

  /// How many triangles with area the ray touches, at t ≥ 0.
  [[nodiscard]] std::uint32_t count(const Ray& ray) const;
  /// Whether the ray touches a triangle with area, at t ≥ 0.
  [[nodiscard]] bool touches(const Ray& ray, std::uint32_t triangle) const;
  /// Where the line of a ray crosses the plane of one triangle, compared with where it crosses that
  /// of another: -1 if before, 0 if at the same t, 1 if behind. nullopt if it is parallel to one.
  [[nodiscard]] std::optional<int> order(const Ray& ray, std::uint32_t one,
                                         std::uint32_t other) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace fathom::validation
