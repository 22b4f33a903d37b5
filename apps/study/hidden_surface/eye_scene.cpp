#include <fmt/format.h>

#include <algorithm>

#include "apps/study/hidden_surface/sight.h"
#include "apps/study/pipeline_scenes.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/rounding.h"

namespace fathom::studies {
namespace {

using Polygon = std::vector<MeshPoint>;

double rounded(const Dyadic& x) {
  return round_to_binary64(Ratio(x));
}

/// The part of a polygon with z ≥ near. Neighbours get the same new corner on an edge they share.
Polygon cut_off(const Polygon& polygon, double near) {
  Polygon rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const MeshPoint &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (a.z >= near) rest.push_back(a);
    if ((a.z >= near) == (b.z >= near)) continue;
    const auto& [from, to] =
        std::minmax(a, b, [](const MeshPoint& p, const MeshPoint& q) { return p.z < q.z; });
    const double t = (near - from.z) / (to.z - from.z);
    rest.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y), near});
  }
  return rest;
}

}  // namespace

SceneView seen_from_eye(const SceneView& view) {
  const Camera& camera = view.camera;
  if (!is_perspective(camera.projection) || camera.projection.skew != 0)
    throw UsageError("the study hidden-surface takes perspective cameras without skew");
  if (const std::size_t count = triangle_count(view.scene); count > most_triangles_to_paint)
    throw UsageError(
        fmt::format("{} triangles; the painter's algorithm compares every pair, so the study "
                    "hidden-surface takes at most {}",
                    count, most_triangles_to_paint));
  std::vector<MeshPoint> vertices;
  std::vector<CornerIndices> triangles;
  for (const Object& object : view.scene.objects) {
    const Mesh& mesh = view.scene.meshes[object.mesh];
    for (const CornerIndices& t : mesh.triangles) {
      Polygon corners;
      for (const std::uint32_t v : t) {
        const CameraPoint p = to_camera(camera.world_to_camera, to_world(object, mesh.vertices[v]));
        corners.push_back({rounded(p.x), rounded(p.y), rounded(p.z)});
      }
      if (std::all_of(corners.begin(), corners.end(),
                      [&](const MeshPoint& p) { return p.z > camera.far; }))
        continue;
      const Polygon seen = cut_off(corners, camera.near);
      const auto first = static_cast<std::uint32_t>(vertices.size());
      vertices.insert(vertices.end(), seen.begin(), seen.end());
      for (std::uint32_t i = 2; i < seen.size(); ++i)
        triangles.push_back({first, first + i - 1, first + i});
    }
  }
  if (triangles.empty()) throw UsageError("the camera sees nothing of the scene");
  SceneView result{view.name, scene_of(std::move(vertices), std::move(triangles)), camera};
  const PrincipalPoint middle = principal_point(camera.projection);
  result.camera.projection.cx = middle.x;
  result.camera.projection.cy = middle.y;
  result.camera.projection.pixel_centre = 0.5;
  result.camera.world_to_camera = Camera{}.world_to_camera;
  return result;
}

Scene thinned(const Scene& scene, std::size_t count) {
  const auto& all = scene.meshes[0].triangles;
  std::vector<CornerIndices> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
  return scene_of({scene.meshes[0].vertices.begin(), scene.meshes[0].vertices.end()},
                  std::move(some));
}

}  // namespace fathom::studies
