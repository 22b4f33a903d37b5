#pragma once

#include <optional>
#include <string>

#include "fathom/failures/warnings.h"
#include "fathom/text/json_value.h"

namespace fathom::mesh_files {

/// Refuses an asset that requires an extension which could put its triangles elsewhere than where
/// they are read. Warns of those that change textures if `attributes` were asked for: no image of
/// an asset is opened.
/// Fails    InputError that names the extension.
/// Source   [GLTF20] 3.12 (extensions)
void check_required_extensions(const text::JsonValue& root, bool attributes,
                               const std::string& file, Warnings& warnings);

/// Whether the asset says that it uses an extension, or that it cannot be read without it.
bool uses_extension(const text::JsonValue& root, const char* name);
bool requires_extension(const text::JsonValue& root, const char* name);

/// What an extension says of a part of the asset.
std::optional<text::JsonValue> find_extension(const text::JsonValue& part, const char* name);

}  // namespace fathom::mesh_files
