#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "fathom/files/source.h"
#include "fathom/mesh/mesh.h"
#include "fathom/mesh/object.h"
#include "fathom/mesh_files/read_options.h"

namespace fathom::mesh_files {

/// The placed meshes of a glTF asset.
struct GltfAsset {
  std::vector<Mesh> meshes;
  /// Object::mesh counts from the first of `meshes`; Object::source is not set.
  std::vector<Object> objects;
  /// External buffers, in the order of loading; the asset's own file is left to the caller.
  std::vector<Source> buffers;
  /// The libraries of others that have decoded something of it: "Draco 1.5.5"; mostly empty.
  std::string reader;
};

/// Reads a glTF 2.0 asset (.gltf or .glb): one object per node with a mesh, depth first, of the
/// default scene, or of the first if none is named; an asset without scenes gives all its nodes,
/// with a warning. Nodes that show the same glTF mesh share a Mesh. Faces are numbered over all
/// objects of the asset. No image is opened. If asked for, triangles have the name of their
/// material, their group that of the glTF mesh, their part that of the node; what has none is
/// "material 3", "mesh 3", "node 3" by its number in the file. A node with EXT_mesh_gpu_instancing
/// gives an object for each instance, with the node's name and its number: "tree[7]".
///
/// `path` names the file in messages; buffers beside it are looked for from its folder.
/// Exact    positions are binary32, widened, or integers (KHR_mesh_quantization), which are
///          rounded once where they are normalized; transforms of nodes and instances are composed
///          exactly, and a quaternion means the polynomial matrix of the glTF specification.
/// Fails    InputError: one line that names the file and the key or byte; also where buffers lie
///          outside the asset's folder, or more would be read than the files are worth: see
///          ReadOptions::outside_files and max_expansion.
/// Ignored  with a warning: points, lines, skins, morph targets; silently: animations and cameras.
/// Source   [GLTF20]
GltfAsset read_gltf(std::span<const std::byte> bytes, const std::filesystem::path& path,
                    const ReadOptions& options, Warnings& warnings);

}  // namespace fathom::mesh_files
