#pragma once

#include "fathom/gltf/gltf_placement.h"
#include "fathom/text/json_value.h"

/// Where the nodes of a glTF lie. Only for .cpp files of this room, of mesh_files/ and of camera/.
/// Source   [GLTF20] 3.5.3 (transformations)
namespace fathom::gltf {

/// What a node says of its place in its parent: a matrix, or a GltfPlacement.
/// Fails    InputError: both, or a matrix that is not affine.
WorldFromMesh read_transform_of_node(const text::JsonValue& node);

}  // namespace fathom::gltf
