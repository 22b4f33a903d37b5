#pragma once

#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/scene/scene.h"

namespace fathom::checks {

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

/// A closed box around the origin: |x|, |y| and |z| up to these.
inline Scene box_scene(double x, double y, double z) {
  std::vector<MeshPoint> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? x : -x, i & 2 ? y : -y, i & 4 ? z : -z});
  return scene_of(corners, {{0, 1, 3},
                            {0, 3, 2},
                            {4, 6, 7},
                            {4, 7, 5},
                            {0, 4, 5},
                            {0, 5, 1},
                            {2, 3, 7},
                            {2, 7, 6},
                            {0, 2, 6},
                            {0, 6, 4},
                            {1, 5, 7},
                            {1, 7, 3}});
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

}  // namespace fathom::checks
