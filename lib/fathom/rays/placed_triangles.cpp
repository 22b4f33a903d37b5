#include "fathom/rays/placed_triangles.h"

#include <algorithm>
#include <cmath>

#include "fathom/numeric/rounding.h"
#include "fathom/threads/threads.h"

namespace fathom::rays {
namespace {

/// The t with |x| < 2^t of a number that is not 0.
long top(const Dyadic& x) {
  return x.top();
}
long top(double x) {
  return std::ilogb(x) + 1L;
}

template <class Point>
long greatest_top(const Point& p, long greatest) {
  for (const auto* x : {&p.x, &p.y, &p.z})
    if (!(*x == 0)) greatest = std::max(greatest, top(*x));
  return greatest;
}

/// For each vertex: whether a triangle has it, or the mesh is a cloud of points. In a mesh with
/// triangles, a vertex without a triangle may be anywhere.
std::vector<bool> vertices_that_count(const Mesh& mesh) {
  std::vector<bool> are_corners(mesh.vertices.size(), mesh.triangles.empty());
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) are_corners[corner] = true;
  return are_corners;
}

/// The least power of a double that is not 0.
constexpr long least_power = -1100;

}  // namespace

long power_of_unit(const TriangleSource& triangles) {
  long power = least_power;
  triangles.for_each_part(0, [&](const TriangleSource::Part& part) {
    const std::vector<bool> counts = vertices_that_count(part.mesh);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      if (!counts[i]) continue;
      const MeshPoint& p = part.mesh.vertices[i];
      power = part.object.placed_as_is ? greatest_top(p, power)
                                       : greatest_top(part.object.world_from_mesh(p), power);
    }
  });
  return power;
}

Vector in_unit(const Object& object, const MeshPoint& p, long power) {
  if (object.placed_as_is) {
    const int exponent = static_cast<int>(-power);
    return {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
  }
  const WorldPoint X = object.world_from_mesh(p);
  const auto round = [&](const Dyadic& x) { return round_to_binary64(Ratio(x.scaled(-power))); };
  return {round(X.x), round(X.y), round(X.z)};
}

PlacedTriangles::PlacedTriangles(const TriangleSource& triangles, long power)
    : power_(power), corners_(triangles.count()) {
  triangles.for_each_part(0, [&](const TriangleSource::Part& part) {
    const Mesh& mesh = part.mesh;
    std::vector<Vector> vertices(mesh.vertices.size());
    parallel_for(std::size_t{0}, vertices.size(), [&](std::size_t i) {
      vertices[i] = in_unit(part.object, mesh.vertices[i], power);
    });
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i)
        corners_[part.first_number + t][i] = vertices[mesh.triangles[t][i]];
    }
  });
}

}  // namespace fathom::rays
