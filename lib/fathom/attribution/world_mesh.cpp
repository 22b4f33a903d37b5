#include "fathom/attribution/world_mesh.h"

#include <algorithm>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_fault.h"

namespace fathom::attribution {
namespace {

std::array<double, 3> place(const Object& object, const MeshPoint& p) {
  if (object.placed_as_is) return {p.x, p.y, p.z};
  const WorldPoint world = object.world_from_mesh(p);
  return {round_to_binary64(world.x), round_to_binary64(world.y), round_to_binary64(world.z)};
}

}  // namespace

WorldMesh world_mesh(const Scene& scene) {
  const StandardArithmetic standard;
  require_valid(scene);
  std::size_t points = 0;
  for (const Object& object : scene.objects) points += scene.meshes[object.mesh].vertices.size();
  if (points > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("the scene has more than 4294967295 corners, more than a renderer numbers");
  }

  WorldMesh world;
  world.points.reserve(points);
  world.triangles.reserve(triangle_count(scene));
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    const auto first = static_cast<std::uint32_t>(world.points.size());
    for (const MeshPoint& p : mesh.vertices) world.points.push_back(place(object, p));
    for (const auto& [a, b, c] : mesh.triangles) {
      world.triangles.push_back({first + a, first + b, first + c});
    }
  }
  return world;
}

std::optional<WorldBounds> box_of(const WorldMesh& mesh) {
  const StandardArithmetic standard;
  if (mesh.points.empty()) return std::nullopt;
  WorldBounds box{mesh.points.front(), mesh.points.front()};
  for (const auto& p : mesh.points) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = std::min(box.lower[k], p[k]);
      box.upper[k] = std::max(box.upper[k], p[k]);
    }
  }
  return box;
}

}  // namespace fathom::attribution
