#pragma once

#include <memory>
#include <optional>

#include "fathom/mesh_files/gltf/gltf_accessor.h"
#include "fathom/text/json_value.h"

/// The parts of a glTF primitive, also of primitives compressed by Draco. Only for .cpp files of
/// this module.
/// Source   [GLTF20] 3.7.2 (geometry); [KDMC18]
namespace fathom::mesh_files {

/// The accessors of a primitive; null if it is missing or was not requested.
struct GltfPrimitiveAccessors {
  std::shared_ptr<const GltfAccessor> positions, texture_coordinates, normals, colours, indices;
};

/// Opens the accessors of a primitive; all but positions and indices only if `attributes` are
/// requested. Primitives that name the same accessor get the same object. A primitive that is only
/// available compressed by Draco is decoded into new accessors.
GltfPrimitiveAccessors open_primitive(const text::JsonValue& primitive, GltfAccessors& accessors,
                                      bool attributes);

/// The Draco extension of a primitive that must be decoded: of a primitive without uncompressed
/// positions, and of every primitive if the asset requires the extension.
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
