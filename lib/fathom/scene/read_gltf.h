#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "fathom/scene/read_scene.h"

namespace fathom {

/// Appends the objects of a glTF 2.0 asset (.gltf or .glb) to a scene: one per node with a mesh,
/// depth first, of the default scene, or of the first where none is named; an asset without scenes
/// gives all its nodes, with a warning. Nodes that show the same glTF mesh share a Mesh. Faces are
/// numbered over all objects of the asset. No image is opened.
///
/// `path` names the file in messages; buffers beside it are found from its folder. External
/// buffers are appended to Scene::sources; the asset's own file is the caller's.
/// Exact    positions are binary32, widened; node transforms are composed exactly, a quaternion
///          meaning the polynomial matrix of the glTF specification.
/// Fails    InputError: one line that names the file and the key or byte. Then `scene` may hold
///          part of the asset.
/// Ignored  with a warning: points, lines, skins, morph targets; animations and cameras silently.
/// Source   Khronos Group, glTF 2.0 specification.
void append_gltf(Scene& scene, std::span<const std::byte> bytes, const std::filesystem::path& path,
                 const ReadOptions& options, Warnings& warnings);

}  // namespace fathom
