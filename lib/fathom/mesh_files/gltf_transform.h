#pragma once

#include <array>

#include "fathom/geometry/frames.h"
#include "fathom/text/json_value.h"

/// The placements of glTF nodes. For this room's .cpp files only.
/// Source   [GLTF20] 3.5.3 (transformations)
namespace fathom::mesh_files {

/// Translation, rotation (a quaternion x, y, z, w) and scale. All numbers are finite.
struct GltfPlacement {
  std::array<double, 3> translation{0, 0, 0};
  std::array<double, 4> rotation{0, 0, 0, 1};
  std::array<double, 3> scale{1, 1, 1};
};

/// T·R·S, exactly; R is the polynomial matrix of the quaternion, whatever its length.
WorldFromMesh transform_of(const GltfPlacement& placement);

/// What a node says of its place in its parent: a matrix, or a GltfPlacement.
/// Fails    InputError: both, or a matrix that is not affine.
WorldFromMesh read_transform_of_node(const text::JsonValue& node);

}  // namespace fathom::mesh_files
