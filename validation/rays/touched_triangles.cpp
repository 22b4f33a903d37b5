#include "validation/rays/touched_triangles.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>

namespace fathom::validation {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Rationals = CGAL::Simple_cartesian<CGAL::Exact_rational>;

/// t where a ray's line crosses the plane of a triangle; nullopt if it is parallel.
std::optional<CGAL::Exact_rational> crossing(const Ray& ray, const attribution::WorldMesh& mesh,
                                             std::uint32_t triangle) {
  const auto corner = [&](std::size_t k) {
    return point_of<Rationals>(mesh.points[mesh.triangles[triangle][k]]);
  };
  const auto line = ray_of<Rationals>(ray);
  const auto n = CGAL::cross_product(corner(1) - corner(0), corner(2) - corner(0));
  const CGAL::Exact_rational along = n * line.to_vector();
  if (CGAL::is_zero(along)) return std::nullopt;
  return (n * (corner(0) - line.source())) / along;
}

Triangles with_area(Triangles triangles) {
  std::erase_if(triangles, [](const Kernel::Triangle_3& t) { return t.is_degenerate(); });
  return triangles;
}

}  // namespace

struct TouchedTriangles::Parts {
  attribution::WorldMesh mesh;
  Triangles triangles;
  Triangles solid;
  Tree tree;

  explicit Parts(const attribution::WorldMesh& given)
      : mesh(given),
        triangles(triangles_of<Kernel>(mesh)),
        solid(with_area(triangles)),
        tree(solid.begin(), solid.end()) {}
};

TouchedTriangles::TouchedTriangles(const attribution::WorldMesh& mesh)
    : parts_(std::make_unique<Parts>(mesh)) {}

TouchedTriangles::~TouchedTriangles() = default;

std::uint32_t TouchedTriangles::count(const Ray& ray) const {
  return static_cast<std::uint32_t>(
      parts_->tree.number_of_intersected_primitives(ray_of<Kernel>(ray)));
}

bool TouchedTriangles::touches(const Ray& ray, std::uint32_t triangle) const {
  if (triangle >= parts_->triangles.size()) return false;
  const Kernel::Triangle_3& one = parts_->triangles[triangle];
  return !one.is_degenerate() && CGAL::do_intersect(ray_of<Kernel>(ray), one);
}

std::optional<int> TouchedTriangles::order(const Ray& ray, std::uint32_t one,
                                           std::uint32_t other) const {
  const auto a = crossing(ray, parts_->mesh, one), b = crossing(ray, parts_->mesh, other);
  if (!a || !b) return std::nullopt;
  return *a < *b ? -1 : *a == *b ? 0 : 1;
}

}  // namespace fathom::validation
