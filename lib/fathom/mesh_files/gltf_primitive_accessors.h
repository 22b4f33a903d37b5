#pragma once

#include <memory>

#include "fathom/mesh_files/gltf_accessor.h"
#include "fathom/text/json_value.h"

/// What a glTF primitive is made of. For this room's .cpp files only.
/// Source   [GLTF20] 3.7.2 (geometry)
namespace fathom::mesh_files {

/// The accessors of a primitive; null where it has none, or none was asked for.
struct GltfPrimitiveAccessors {
  std::shared_ptr<const GltfAccessor> positions, texture_coordinates, normals, colours, indices;
};

/// Opens the accessors of a primitive; all but positions and indices only if `attributes` are asked
/// for. Primitives that name the same accessor get the same object. Whatever a primitive is made of
/// comes from here. A primitive that Draco has compressed is decoded into accessors of its own,
/// where the asset does not also have what it is made of as it is.
GltfPrimitiveAccessors open_primitive(const text::JsonValue& primitive, GltfAccessors& accessors,
                                      bool attributes);

}  // namespace fathom::mesh_files
