#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "fathom/area/image_cell.h"
#include "fathom/scene/triangle_source.h"
#include "tests/inputs/scene_building.h"

namespace fathom::checks {

/// Each triangle of a scene by its number; nothing where it projects to no area.
inline std::vector<std::optional<area::SurfaceRegion>> surfaces_by_number(const Scene& scene,
                                                                          const Camera& camera) {
  std::vector<std::optional<area::SurfaceRegion>> surfaces;
  TierCounts counts;
  const TriangleSource triangles(scene);
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    const auto t = triangle::project(triangles.world_corners(number), number, camera, counts);
    surfaces.push_back(area::surface_region(t, camera));
  }
  return surfaces;
}

/// All triangles of a scene that project to an area.
inline std::vector<area::SurfaceRegion> surfaces_of(const Scene& scene, const Camera& camera) {
  std::vector<area::SurfaceRegion> surfaces;
  for (auto& surface : surfaces_by_number(scene, camera)) {
    if (surface) surfaces.push_back(std::move(*surface));
  }
  return surfaces;
}

/// An orthographic camera that leaves x, y and z as u, v and D.
inline Camera plain_camera(std::uint32_t width, std::uint32_t height) {
  Camera camera = camera_of(width, height, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0;
  return camera;
}

}  // namespace fathom::checks
