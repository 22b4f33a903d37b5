#pragma once

#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

namespace fathom::testing {

/// A scene of one object.
inline Scene scene_of(std::vector<MeshPoint> vertices, std::vector<CornerIndices> triangles) {
  Scene scene;
  Mesh mesh;
  mesh.vertices = std::move(vertices);
  mesh.triangles = std::move(triangles);
  mesh.face_count = mesh.triangles.size();
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back({.name = "object"});
  return scene;
}

/// A camera at the origin that looks along +z, its principal point in the middle.
inline Camera camera_of(std::uint32_t width, std::uint32_t height, double focal_length) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection.fx = camera.projection.fy = focal_length;
  camera.projection.cx = width / 2.0;
  camera.projection.cy = height / 2.0;
  return camera;
}

}  // namespace fathom::testing
