#include "fathom/attribution/truth.h"

#include <array>
#include <cstring>
#include <limits>
#include <memory>
#include <unordered_map>
#include <vector>

#include "fathom/attribution/model/lens_samples.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/render.h"

namespace fathom::attribution {
namespace {

struct PositionHash {
  std::size_t operator()(const std::array<double, 3>& p) const {
    std::size_t hash = 0;
    for (const double x : p) {
      std::uint64_t bits = 0;
      const double value = x == 0 ? 0 : x;  // −0 is 0
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15U;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

using Points = std::vector<std::array<double, 3>>;

void append_numbers(const Points& points, std::vector<std::uint32_t>& numbers) {
  std::unordered_map<std::array<double, 3>, std::uint32_t, PositionHash> first;
  for (const auto& point : points) {
    numbers.push_back(first.emplace(point, numbers.size()).first->second);
  }
}

}  // namespace

std::vector<std::uint32_t> corner_numbers(const WorldMesh& mesh) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(mesh.points.size());
  append_numbers(mesh.points, numbers);
  return numbers;
}

std::vector<std::uint32_t> corner_numbers(const std::vector<RasterPart>& parts) {
  std::vector<std::uint32_t> numbers;
  for (const RasterPart& part : parts) append_numbers(*part.points, numbers);
  return numbers;
}

namespace {

void set_maps(Truth& truth, const Scene& scene) {
  const RenderOptions options{.channels = {Channel::Z, Channel::Zlow, Channel::id}};
  const DepthMap map = render(scene, whole_camera(truth), options).map;
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
  Truth truth{.mesh = world_mesh(scene), .camera = without_lens(camera)};
  if (bends_rays(camera.projection)) truth.lens = std::make_shared<LensSamples>(camera, 0.5, 0.5);
  truth.corner_numbers = corner_numbers(truth.mesh);
  set_maps(truth, scene);
  return truth;
}

const Camera& whole_camera(const Truth& truth) {
  return truth.lens ? truth.lens->camera() : truth.camera;
}

Truth seen_by(const Truth& truth, const Camera& camera) {
  const StandardArithmetic standard;
  Truth seen{.mesh = truth.mesh, .camera = camera, .corner_numbers = truth.corner_numbers};
  set_maps(seen, scene_of(truth.mesh));
  return seen;
}

}  // namespace fathom::attribution
