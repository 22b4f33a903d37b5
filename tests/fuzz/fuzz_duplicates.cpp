// Scenes in which triangles repeat and lie in few planes, by both engines: the maps must be the
// same, bit for bit, and so must the areas that a scene has with one of each.
#include <array>

#include "fathom/area/visible_areas.h"
#include "tests/fuzz/engine_inputs.h"

namespace fathom::fuzz {
namespace {

constexpr int planes = 4;

/// Points of few planes z = (ax + by + c)/4, on a coarse grid.
Scene scene_from(Bytes& bytes) {
  std::array<std::array<double, 3>, planes> coefficients;
  for (auto& [a, b, c] : coefficients) {
    a = bytes.below(5) - 2;
    b = bytes.below(5) - 2;
    c = bytes.below(40) + 1;
  }
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  while (!bytes.is_empty() && triangles.size() < 20) {
    const int form = bytes.next();
    if (!triangles.empty() && form >= 160) {
      // One of those before, from another corner on or the other way round.
      CornerIndices t =
          triangles[static_cast<std::size_t>(bytes.below(static_cast<int>(triangles.size())))];
      if (form & 1) t = {t[1], t[2], t[0]};
      if (form & 2) std::swap(t[0], t[1]);
      triangles.push_back(t);
      continue;
    }
    const auto& [a, b, c] = coefficients[static_cast<std::size_t>(form % planes)];
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (int corner = 0; corner < 3; ++corner) {
      const int place = bytes.next();
      const double x = place % 9 - 4, y = place / 9 % 9 - 4;
      vertices.push_back({x, y, (a * x + b * y + c) / 4});
    }
    triangles.push_back({first, first + 1, first + 2});
  }
  return checks::scene_of(std::move(vertices), std::move(triangles));
}

/// A copy of the last triangle behind all others hides nothing and shows nothing.
void expect_same_areas_with_one_more(Scene scene, const Camera& camera) {
  const VisibleAreas before = visible_areas(scene, camera, {.threads = 1});
  Mesh& mesh = scene.meshes[0];
  mesh.triangles.push_back(mesh.triangles.back());
  ++mesh.face_count;
  const VisibleAreas after = visible_areas(scene, camera, {.threads = 1});
  for (std::size_t t = 0; t < before.triangles.size(); ++t)
    if (after.triangles[t].visible != before.triangles[t].visible) std::abort();
  if (after.triangles.back().visible != 0) std::abort();
}

}  // namespace
}  // namespace fathom::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fathom;
  fuzz::Bytes bytes(data, size);
  Camera camera = fuzz::camera_from(bytes);
  if (find_fault(camera)) return 0;
  // Few pixels: in each of them all triangles may lie.
  camera.width = 1 + camera.width % 12;
  camera.height = 1 + camera.height % 6;
  camera.projection.cx = camera.width / 2.0;
  camera.projection.cy = camera.height / 2.0;
  const RenderOptions options = fuzz::options_from(bytes);
  const Scene scene = fuzz::scene_from(bytes);
  fuzz::expect_same_maps(scene, camera, options);
  const std::size_t count = scene.meshes[0].triangles.size();
  if (count > 0 && count < 7) fuzz::expect_same_areas_with_one_more(scene, camera);
  return 0;
}
