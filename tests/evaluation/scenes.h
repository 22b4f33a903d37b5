#pragma once

#include <cstdint>
#include <random>

#include "tests/inputs/scene_building.h"

namespace fathom::evaluation::test {

/// Triangles with whole coordinates in [−size, size], among them ones that share corners and edges,
/// lie in one plane, coincide, or are seen edge on; none without area.
inline Scene whole_soup(std::mt19937& random, int size, int triangles) {
  std::vector<MeshPoint> vertices;
  const auto coordinate = [&] {
    return static_cast<double>(static_cast<int>(random() % (2 * size + 1)) - size);
  };
  for (int i = 0; i < triangles + 2; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    vertices.push_back({x, y, z});
  }
  std::vector<CornerIndices> list;
  const auto n = static_cast<std::uint32_t>(vertices.size());
  while (list.size() < static_cast<std::size_t>(triangles)) {
    const std::uint32_t a = random() % n, b = random() % n, c = random() % n;
    const MeshPoint &A = vertices[a], &B = vertices[b], &C = vertices[c];
    const double nx = (B.y - A.y) * (C.z - A.z) - (B.z - A.z) * (C.y - A.y);
    const double ny = (B.z - A.z) * (C.x - A.x) - (B.x - A.x) * (C.z - A.z);
    const double nz = (B.x - A.x) * (C.y - A.y) - (B.y - A.y) * (C.x - A.x);
    if (nx == 0 && ny == 0 && nz == 0) {
      // Three points may lie in a line.
      if (n == 3) vertices[a] = {coordinate(), coordinate(), coordinate()};
      continue;
    }
    list.push_back({a, b, c});
  }
  return checks::scene_of(std::move(vertices), std::move(list));
}

/// The same scene, all coordinates times `factor`.
inline Scene scaled(Scene scene, double factor) {
  for (MeshPoint& p : scene.meshes[0].vertices) p = {p.x * factor, p.y * factor, p.z * factor};
  return scene;
}

}  // namespace fathom::evaluation::test
