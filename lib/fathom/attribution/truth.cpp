#include "fathom/attribution/truth.h"

#include <limits>

#include "fathom/attribution/pixels/corner_numbers.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/render.h"

namespace fathom::attribution {
namespace {

void set_maps(Truth& truth, const Scene& scene) {
  const DepthMap map =
      render(scene, truth.camera, {.channels = {Channel::Z, Channel::Zlow, Channel::id}}).map;
  const auto& high = *map.values<float>("Z");
  const auto& low = *map.values<float>("Zlow");
  const auto& id = *map.values<std::uint32_t>("id");
  truth.triangles.assign(id.begin(), id.end());
  truth.depths.resize(high.size());
  for (std::size_t i = 0; i < high.size(); ++i) {
    truth.depths[i] = id[i] == no_surface ? std::numeric_limits<double>::infinity()
                                          : double{high[i]} + double{low[i]};
  }
}

/// One object, placed as it is: triangles keep their numbers.
Scene scene_of(const WorldMesh& world) {
  Scene scene;
  Mesh& mesh = scene.meshes.emplace_back();
  for (const auto& [x, y, z] : world.points) mesh.vertices.push_back({x, y, z});
  mesh.triangles = world.triangles;
  scene.objects.push_back({.name = "world"});
  return scene;
}

}  // namespace

Truth make_truth(const Scene& scene, const Camera& camera) {
  const StandardArithmetic standard;
  Truth truth{.mesh = world_mesh(scene), .camera = camera};
  truth.corner_numbers = corner_numbers(truth.mesh);
  set_maps(truth, scene);
  return truth;
}

Truth seen_by(const Truth& truth, const Camera& camera) {
  const StandardArithmetic standard;
  Truth seen{.mesh = truth.mesh, .camera = camera, .corner_numbers = truth.corner_numbers};
  set_maps(seen, scene_of(truth.mesh));
  return seen;
}

}  // namespace fathom::attribution
