#pragma once

#include <vector>

#include "fathom/scene/scene.h"

namespace fathom::checks {

/// A scene of these points, as triangles that have no area but bounds.
inline Scene scene_of_points(const std::vector<MeshPoint>& vertices) {
  Mesh mesh;
  mesh.vertices = vertices;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) mesh.triangles.push_back({0, i, i});
  mesh.face_count = mesh.triangles.size();
  Scene scene;
  scene.meshes.push_back(mesh);
  scene.objects.emplace_back();
  return scene;
}

}  // namespace fathom::checks
