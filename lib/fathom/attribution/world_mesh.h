#pragma once

#include <array>
#include <optional>
#include <vector>

#include "fathom/mesh/mesh.h"
#include "fathom/scene/bounds.h"
#include "fathom/scene/scene.h"

/// The scene as other renderers are given it.
namespace fathom::attribution {

/// All triangles of a scene as one mesh, numbered as in the scene.
///
/// Frame    world, scene units.
/// Exact    points of objects without a transform; points of other objects are rounded once, to
///          binary64.
struct WorldMesh {
  std::vector<std::array<double, 3>> points;
  MeshArray<CornerIndices> triangles;
};

/// Fails    InputError if the scene has a fault (find_fault), or more than 2³² − 1 corners in all.
WorldMesh world_mesh(const Scene& scene);

/// The smallest box that contains every point, whether a triangle uses it or not. nullopt if there
/// is no point.
std::optional<WorldBounds> box_of(const WorldMesh& mesh);

}  // namespace fathom::attribution
