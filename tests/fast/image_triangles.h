#pragma once

#include <array>
#include <cmath>

#include "fathom/fast/vertices/vertex.h"
#include "fathom/triangle/projected_triangle.h"
#include "tests/inputs/scene_building.h"
#include "tests/numeric/random_numbers.h"

namespace fathom::checks {

/// Triangles near the image: of all sizes, many of them thin.
inline std::array<MeshPoint, 3> triangle_from(Numbers& n) {
  const MeshPoint A{n.unit() * 2, n.unit() * 2, 1 + n.unit() / 2};
  const double size = std::ldexp(1, -n.below(12));
  const auto near = [&](const MeshPoint& p, double s) {
    return MeshPoint{p.x + n.unit() * s, p.y + n.unit() * s, p.z + n.unit() * s / 4};
  };
  MeshPoint B = near(A, size), C = near(A, size);
  if (n.below(3) == 0) {  // thin: C near the line AB
    const double t = n.unit() * 2;
    const double off = size * std::ldexp(1, -n.below(40));
    C = near({A.x + t * (B.x - A.x), A.y + t * (B.y - A.y), A.z + t * (B.z - A.z)}, off);
  }
  return {A, B, C};
}

/// Its corners as the engine computes them, and exactly.
struct ImageTriangle {
  triangle::ProjectedTriangle exact;
  std::array<fast::ImageVertex, 3> vertices;
};

inline ImageTriangle project_both(const std::array<MeshPoint, 3>& corners, const Camera& camera) {
  ImageTriangle t;
  std::array<WorldPoint, 3> world;
  const fast::VertexTransform transform(Object{}, camera);
  for (std::size_t i = 0; i < 3; ++i) {
    world[i] = WorldFromMesh{}(corners[i]);
    t.vertices[i] = transform(corners[i]);
  }
  TierCounts counts;
  t.exact = triangle::project(world, 0, camera, counts);
  return t;
}

inline Camera plain_camera(bool perspective) {
  Camera camera = camera_of(640, 480, 301.7);
  camera.projection.cx = 320.3;
  camera.projection.skew = 0.3;
  if (!perspective) camera.projection.model = ProjectionModel::orthographic;
  camera.world_to_camera = {{{0.9, 0.1, -0.2, 0.03}, {0.05, 1.1, 0.3, -0.1}, {0.2, -0.3, 0.8, 3}}};
  return camera;
}

/// A camera that leaves coordinates as they are: u = x/z or x.
inline Camera bare_camera(bool perspective) {
  Camera camera = camera_of(64, 64, 1);
  camera.projection.cx = camera.projection.cy = 0;
  if (!perspective) camera.projection.model = ProjectionModel::orthographic;
  return camera;
}

/// Corners given directly, for a bare camera, their errors as large as their bounds allow: the
/// exact corners are the computed ones moved by the bound, in directions of which some are the
/// worst.
inline ImageTriangle worst_triangle(Numbers& n, const Camera& camera) {
  const bool perspective = is_perspective(camera.projection);
  const double e = std::ldexp(1, -13 - n.below(12));
  ImageTriangle t;
  std::array<WorldPoint, 3> world;
  const int size = 1 << n.below(7);
  for (std::size_t k = 0; k < 3; ++k) {
    const double q = perspective ? std::ldexp(1, -n.below(4)) : n.below(9) - 4.0;
    const double u = n.below(size + 1) + n.below(2) * 0.5, v = n.below(size + 1);
    t.vertices[k] = {u, v, q, fast::upper_half(e) << 32 | fast::upper_half(e * 0x1p-10)};
    const Dyadic exact_u = Dyadic(u) + Dyadic((n.below(2) * 2 - 1) * e);
    const Dyadic exact_v = Dyadic(v) + Dyadic((n.below(2) * 2 - 1) * e);
    const Dyadic D = perspective ? Dyadic(1 / q) : Dyadic(-q);
    world[k] =
        perspective ? WorldPoint{exact_u * D, exact_v * D, D} : WorldPoint{exact_u, exact_v, D};
  }
  TierCounts counts;
  t.exact = triangle::project(world, 0, camera, counts);
  return t;
}

}  // namespace fathom::checks
