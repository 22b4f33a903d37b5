#include "validation/rays/ray_engines.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/version.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <variant>

#include "fathom/failures/unknown_name.h"
#include "validation/rays/touched_triangles.h"

namespace fathom::validation {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

/// t of a point of a ray.
double place_of(const Kernel::Point_3& point, const Kernel::Ray_3& ray) {
  const Kernel::Vector_3 direction = ray.to_vector(), way = point - ray.source();
  return CGAL::to_double(way * direction / (direction * direction));
}

/// The point of a hit. A hit along a triangle's plane is a segment, which begins the nearest.
struct PointOfHit {
  Kernel::Ray_3 ray;

  double operator()(const Kernel::Point_3& point) const { return place_of(point, ray); }
  double operator()(const Kernel::Segment_3& segment) const {
    return std::min(place_of(segment.source(), ray), place_of(segment.target(), ray));
  }
};

/// CGAL 6 returns a variant of the standard library, earlier versions a variant of Boost.
template <class Hit>
double place_of_hit(const Hit& hit, const Kernel::Ray_3& ray) {
#if CGAL_VERSION_NR >= 1060000000
  return std::visit(PointOfHit{ray}, hit);
#else
  return boost::apply_visitor(PointOfHit{ray}, hit);
#endif
}

RayHit nearest_of(const Tree& tree, const Triangles& triangles, const Kernel::Ray_3& ray) {
  const auto hit = tree.first_intersection(ray);
  if (!hit) return {};
  const auto number = std::distance(triangles.begin(), hit->second);
  return {static_cast<std::uint32_t>(number), place_of_hit(hit->first, ray)};
}

}  // namespace

EngineAnswers trace_by_cgal(const attribution::WorldMesh& mesh, std::span<const Ray> rays) {
  const Triangles triangles = triangles_of<Kernel>(mesh);
  const Tree tree(triangles.begin(), triangles.end());
  EngineAnswers answers;
  for (const Ray& given : rays) {
    const auto ray = ray_of<Kernel>(given);
    answers.nearest.push_back(nearest_of(tree, triangles, ray));
    answers.counts.push_back(
        static_cast<std::uint32_t>(tree.number_of_intersected_primitives(ray)));
  }
  return answers;
}

namespace {

constexpr std::array engine_names{std::pair{RayEngine::embree, "embree"},
                                  std::pair{RayEngine::embree_robust, "embree-robust"},
                                  std::pair{RayEngine::cgal, "cgal"}};

}  // namespace

std::string name_of(RayEngine engine) {
  return engine_names.at(static_cast<std::size_t>(engine)).second;
}

std::vector<std::string> ray_engine_names() {
  std::vector<std::string> names;
  names.reserve(engine_names.size());
  for (const auto& [engine, name] : engine_names) names.emplace_back(name);
  return names;
}

RayEngine ray_engine_named(const std::string& name) {
  for (const auto& [engine, known] : engine_names)
    if (name == known) return engine;
  throw UnknownName(fmt::format("there is no ray engine '{}'; there are {}", name,
                                fmt::join(ray_engine_names(), ", ")),
                    name, ray_engine_names());
}

std::string version_of(RayEngine engine) {
  return engine == RayEngine::cgal ? "CGAL " CGAL_VERSION_STR : embree_version_of_rays();
}

EngineAnswers trace(RayEngine engine, const attribution::WorldMesh& mesh,
                    std::span<const Ray> rays) {
  if (engine == RayEngine::cgal) return trace_by_cgal(mesh, rays);
  return trace_by_embree(mesh, rays, engine == RayEngine::embree_robust);
}

}  // namespace fathom::validation
