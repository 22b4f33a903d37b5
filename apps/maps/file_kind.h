#pragma once

#include <string>

namespace fathom::app {

enum class FileKind { mesh, scene, camera, map };

/// Told by the content. JSON with `meshes` is a scene file unless it is glTF, which has `asset`.
/// What cannot be read is taken for a mesh, or for a camera if it looks like JSON: the reader says
/// what is wrong with it.
FileKind kind_of(const std::string& file);

}  // namespace fathom::app
