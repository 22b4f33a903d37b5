#pragma once

#include <array>
#include <cstdint>

#include "fathom/camera/camera.h"

/// What the tests of docs/sources.md share. For each error of the source texts they have the wrong
/// version, which fails, next to the right version, which is what the library computes.
namespace fathom::pipeline {

/// The source's edge function of the edge from a to b.
inline double their_edge(const std::array<double, 2>& a, const std::array<double, 2>& b,
                         const std::array<double, 2>& p) {
  return (p[0] - a[0]) * (b[1] - a[1]) - (p[1] - a[1]) * (b[0] - a[0]);
}

/// Pixels are units of the world: an orthographic look along z.
inline Camera window_camera(std::uint32_t width, std::uint32_t height) {
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.projection.model = ProjectionModel::orthographic;
  camera.near = 0;
  camera.far = 1;
  return camera;
}

}  // namespace fathom::pipeline
