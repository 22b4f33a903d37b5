#pragma once

#include "fathom/scene/scene.h"

namespace fathom::pipeline {

/// A square across the whole view at a depth, an object of its own.
struct Layer {
  double depth = 1;
  DrawState state;
  std::array<float, 3> colour{1, 1, 1};
};

/// Layers in the order in which they are drawn.
inline Scene layers(const std::vector<Layer>& list) {
  Scene scene;
  for (const Layer& layer : list) {
    const double z = layer.depth, s = 8 * z;
    Mesh mesh;
    mesh.vertices = {{-s, -s, z}, {s, -s, z}, {s, s, z}, {-s, s, z}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.face_of_triangle = {0, 0};
    mesh.face_count = 1;
    mesh.colours.assign(4, {layer.colour[0], layer.colour[1], layer.colour[2], 1});
    Object object;
    object.mesh = scene.meshes.size();
    object.name = "layer " + std::to_string(object.mesh);
    scene.meshes.push_back(std::move(mesh));
    scene.objects.push_back(std::move(object));
    scene.draw_states.push_back(layer.state);
  }
  return scene;
}

/// 6 × 4 pixels.
inline Camera camera_of_layers(double near = 0.5, double far = 100) {
  Camera camera;
  camera.width = 6;
  camera.height = 4;
  camera.projection.fx = camera.projection.fy = 4;
  camera.projection.cx = 3;
  camera.projection.cy = 2;
  camera.near = near;
  camera.far = far;
  return camera;
}

}  // namespace fathom::pipeline
