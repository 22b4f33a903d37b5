#pragma once

#include <memory>
#include <optional>

#include "fathom/mesh_files/gltf/gltf_accessor.h"
#include "fathom/text/json_value.h"

/// What a glTF primitive is made of. For this room's .cpp files only.
/// Source   [GLTF20] 3.7.2 (geometry)
/// Primitives that are compressed by Draco. For this room's .cpp files only.
/// Source   [KDMC18]
namespace fathom::mesh_files {

/// The accessors of a primitive; null where it has none, or none was asked for.
struct GltfPrimitiveAccessors {
  std::shared_ptr<const GltfAccessor> positions, texture_coordinates, normals, colours, indices;
};

/// Opens the accessors of a primitive; all but positions and indices only if `attributes` are
/// requested. Primitives that name the same accessor get the same object. A primitive that is only
/// available compressed by Draco is decoded into new accessors.
GltfPrimitiveAccessors open_primitive(const text::JsonValue& primitive, GltfAccessors& accessors,
                                      bool attributes);

/// The extension of a primitive that has to be decoded: of one whose positions are not also there
/// as they are, and of every one of an asset that requires the extension.
std::optional<text::JsonValue> draco_of(const text::JsonValue& primitive,
                                        const GltfAccessors& accessors);

/// The accessors of such a primitive, as open_primitive() gives them. What Draco has not compressed
/// of it is opened as usual.
/// Fails    InputError: it cannot be decoded, its triangles are not of mode 4, or Draco has
///          compressed no positions.
GltfPrimitiveAccessors decode_draco(const text::JsonValue& primitive,
                                    const text::JsonValue& extension, GltfAccessors& accessors,
                                    bool attributes);

}  // namespace fathom::mesh_files
