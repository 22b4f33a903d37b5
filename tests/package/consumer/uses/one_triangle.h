#pragma once

#include <fathom/camera/camera.h>
#include <fathom/scene/scene.h>

/// The half of an image of 4 × 4 pixels above its diagonal, at depth 2.
inline fathom::Scene one_triangle() {
  fathom::Scene scene;
  scene.meshes.emplace_back();
  scene.meshes[0].vertices = {{0, 0, 2}, {4, 0, 2}, {0, 4, 2}};
  scene.meshes[0].triangles = {{0, 1, 2}};
  scene.meshes[0].face_count = 1;
  scene.objects.emplace_back();
  return scene;
}

inline fathom::Camera small_camera() {
  fathom::Camera camera;
  camera.width = camera.height = 4;
  camera.projection.model = fathom::ProjectionModel::orthographic;
  return camera;
}
