#include "fathom/scene/farthest_object.h"

#include <algorithm>
#include <cmath>

#include "fathom/scene/bounds.h"
#include "fathom/text/printable.h"

namespace fathom::scene {
namespace {

double reach_of(const WorldBounds& bounds) {
  double reach = 0;
  for (int axis = 0; axis < 3; ++axis)
    reach = std::max({reach, std::abs(bounds.lower[axis]), std::abs(bounds.upper[axis])});
  return reach;
}

}  // namespace

std::string name_of_farthest_object(const Scene& scene) {
  const Object* farthest = nullptr;
  double farthest_reach = -1;
  Scene part;
  part.meshes.resize(1);
  const Mesh* copied = nullptr;
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    if (copied != &mesh) part.meshes[0] = mesh;
    copied = &mesh;
    part.objects = {object};
    part.objects[0].mesh = 0;
    const auto bounds = world_bounds(part);
    if (!bounds || !(reach_of(*bounds) > farthest_reach)) continue;
    farthest = &object;
    farthest_reach = reach_of(*bounds);
  }
  if (farthest == nullptr) return "the scene";
  std::string object = "object " + text::printable(farthest->name);
  if (farthest->source >= scene.sources.size()) return object;
  return scene.sources[farthest->source].path + ": " + object;
}

}  // namespace fathom::scene
