#pragma once

#include <string_view>

namespace fathom::app {

enum class FileKind { mesh, scene, camera, map };

/// Told by the content of a file. JSON with `meshes` is a scene file unless it is glTF, which has
/// `asset`. What is none of them is taken for a mesh, or for a camera if it looks like JSON: the
/// reader says what is wrong with it.
FileKind kind_of(std::string_view content);

}  // namespace fathom::app
