#include "fathom/reference/probe.h"

#include <algorithm>

#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/triangle/deciders.h"
#include "fathom/triangle/projected_triangle.h"
#include "fathom/triangle/sampling.h"

namespace fathom {
using namespace triangle;

namespace {

/// Exact arithmetic only, without any filter, so that the engines can be checked against it.
std::array<Sign, 3> edge_signs(const ProjectedTriangle& t, const ImagePoint& s) {
  std::array<Sign, 3> signs{};
  for (std::size_t i = 0; i < 3; ++i) signs[i] = t.edges[i].at(s.u, s.v).sign();
  return signs;
}

/// Which signs an interval would settle: those that the reference engine does not ask dyadic numbers for.
std::array<bool, 3> edges_by_interval(const ProjectedTriangle& t, const ImagePoint& s) {
  std::array<bool, 3> by_interval{};
  for (std::size_t i = 0; i < 3; ++i) {
    TierCounts tiers;
    [[maybe_unused]] const Sign sign = t.edges[i].sign_at(s.u, s.v, tiers);
    by_interval[i] = tiers.interval > 0;
  }
  return by_interval;
}

bool covers(const std::array<Sign, 3>& signs, const std::array<bool, 3>& left_or_top) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (signs[i] == Sign::negative || (signs[i] == Sign::zero && !left_or_top[i])) return false;
  }
  return true;
}

}  // namespace

std::string_view CoveringTriangle::facing_decided_by() const {
  return facing_by_interval ? cgal_determinant : dyadic_numbers;
}

std::string_view CoveringTriangle::edge_decided_by(std::size_t i) const {
  return edge_by_interval[i] ? cgal_form : dyadic_numbers;
}

std::vector<CoveringTriangle> probe(const Scene& scene, const Camera& camera, std::uint32_t x,
                                    std::uint32_t y, Cull cull) {
  const StandardArithmetic standard;
  require_renderable(scene, camera);
  const ImagePoint s = centre_of_pixel(x, y);
  std::vector<CoveringTriangle> covering;
  std::uint32_t number = 0;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i, ++number) {
      TierCounts facing;
      const ProjectedTriangle t = project(world_corners(object, mesh, i), number, camera, facing);
      if (t.orientation == Sign::zero) continue;
      const std::array<Sign, 3> signs = edge_signs(t, s);
      if (!covers(signs, t.left_or_top)) continue;
      CoveringTriangle c{.number = number,
                         .origin = origin_of(scene, number),
                         .edge_signs = signs,
                         .left_or_top = t.left_or_top,
                         .front_facing = t.front_facing(),
                         .facing_by_interval = facing.interval > 0,
                         .edge_by_interval = edges_by_interval(t, s),
                         .depth = depth_at(t, s)};
      c.counts = is_in_range(c.depth, camera) && is_kept(t, cull);
      covering.push_back(std::move(c));
    }
  }
  std::stable_sort(covering.begin(), covering.end(), [](const auto& a, const auto& b) {
    if (a.counts != b.counts) return a.counts;
    return a.depth < b.depth;
  });
  return covering;
}

}  // namespace fathom
