#pragma once

#include <filesystem>
#include <vector>

#include "fathom/mesh_files/read_options.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// Reads meshes (OBJ, PLY, STL, OFF, glTF/GLB) and scene files (JSON) in the order given into one
/// scene. A mesh is told by its content where the suffix lies. "-" is standard input.
/// Fails    InputError: one line, "FILE: line N: what is wrong and what was expected" (text), or
///          "FILE: byte N: …" (binary). Overall more than 2³² − 2 triangles are an error.
Scene read_scene(const std::vector<std::filesystem::path>& files, const ReadOptions& options,
                 Warnings& warnings);

}  // namespace fathom
