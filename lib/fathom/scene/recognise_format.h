#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

#include "fathom/scene/read_scene.h"

namespace fathom {

enum class FileKind { obj, ply, stl, off, gltf, scene_json };

/// What a file is: by its content, and where that does not tell (an OBJ or OFF without a word that
/// gives it away, an STL whose header is arbitrary), by the suffix of its path, in any case.
/// nullopt if neither tells.
std::optional<FileKind> recognise_format(std::span<const std::byte> bytes,
                                         const std::filesystem::path& path);

}  // namespace fathom
