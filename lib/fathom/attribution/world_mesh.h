#pragma once

#include <array>
#include <vector>

#include "fathom/mesh/mesh.h"
#include "fathom/scene/scene.h"

/// What renderers that are not ours are given.
namespace fathom::attribution {

/// All triangles of a scene as one mesh in the world, numbered as in the scene.
struct WorldMesh {
  /// Rounded once, to binary64; exact where the objects are placed as they are.
  std::vector<std::array<double, 3>> points;
  std::vector<CornerIndices> triangles;
};

/// Fails    InputError where the scene has more than 2³² − 1 corners in all.
WorldMesh world_mesh(const Scene& scene);

}  // namespace fathom::attribution
