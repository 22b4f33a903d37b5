#pragma once

#include <optional>

#include "fathom/mesh_files/gltf_primitive_accessors.h"

/// Primitives that are compressed by Draco. For this room's .cpp files only.
/// Source   [KDMC18]
namespace fathom::mesh_files {

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
