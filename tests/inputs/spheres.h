#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "fathom/scene/scene.h"

namespace fathom::checks {

/// The unit sphere as `rings` rings of 2·rings quadrilaterals, each of two triangles.
inline Mesh sphere(std::uint32_t rings) {
  Mesh mesh;
  const std::uint32_t columns = 2 * rings;
  for (std::uint32_t i = 0; i <= rings; ++i) {
    for (std::uint32_t k = 0; k < columns; ++k) {
      const double a = std::numbers::pi * i / rings, b = 2 * std::numbers::pi * k / columns;
      mesh.vertices.push_back({std::sin(a) * std::cos(b), std::cos(a), std::sin(a) * std::sin(b)});
    }
  }
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t k = 0; k < columns; ++k) {
      const std::uint32_t next = (k + 1) % columns;
      const std::uint32_t a = i * columns + k, b = i * columns + next;
      mesh.triangles.push_back({a, b, a + columns});
      mesh.triangles.push_back({b, b + columns, a + columns});
    }
  }
  mesh.face_count = mesh.triangles.size();
  return mesh;
}

/// A sphere as it is, and the same mesh turned, mirrored and moved into it.
inline Scene two_spheres(std::uint32_t rings) {
  Scene scene;
  scene.meshes.push_back(sphere(rings));
  scene.objects.push_back({.name = "one"});
  Object moved{.name = "two", .first_face = 0};
  moved.placed_as_is = false;
  moved.world_from_mesh.rows[0] = {0.5, 0.1, 0.0, 0.75};
  moved.world_from_mesh.rows[1] = {0.1, -0.7, 0.3, 0.1};
  moved.world_from_mesh.rows[2] = {0.0, 0.3, 0.6, 0.3};
  scene.objects.push_back(std::move(moved));
  return scene;
}

}  // namespace fathom::checks
