#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/files/source.h"
#include "fathom/mesh/mesh.h"
#include "fathom/mesh/object.h"
#include "fathom/mesh_files/read_options.h"

/// Recognises mesh files and reads them, with a reader for each format. Each reader takes the whole
/// file, checks everything that Mesh promises, and allocates no more than the bytes that are there
/// can fill. `file` is the name for messages. All fail with InputError: "FILE: line N: …" (text) or
/// "FILE: byte N: …" (binary).
namespace fathom::mesh_files {

/// Wavefront OBJ: v, vt, vn and f lines and, if requested, o, g and usemtl (names: ObjSegments); s,
/// mtllib and similar keywords are ignored, other keywords are ignored with a warning. Indices
/// count from 1, negative ones backwards from the last one read; positive ones may point forward.
/// `v x y z w` is the point (x/w, y/w, z/w), with a warning unless w is 1. `v x y z r g b [a]` has
/// a colour; vertices without a colour are white. If no vertex has a z, every z is 0, with a
/// warning. A corner whose texture coordinate or normal is not in the file has none, with a
/// warning. Read in parallel, with a result that does not depend on it.
Mesh read_obj(std::string_view text, const std::string& file, const ReadOptions& options,
              Warnings& warnings);

/// PLY 1.0: ascii, binary little and big endian. Elements `vertex` (x, y, z and, if requested, nx
/// ny nz, s t / u v / texture_u texture_v, red green blue alpha of any type), `face` and
/// `tristrips` (vertex_indices or vertex_index); other elements and properties are skipped. In
/// ascii, rows are lines or, if the number of words fits exactly, a stream of words (PlyTextRows in
/// read_ply.cpp).
Mesh read_ply(std::span<const std::byte> bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings);

/// STL, ascii (several solids, any case, comments) and binary, distinguished by content. Each
/// triangle has its own three vertices: STL does not record shared vertices. With a warning: facets
/// without a normal, no endsolid, bytes after the last triangle.
Mesh read_stl(std::span<const std::byte> bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings);

/// Object File Format, ascii: OFF with the prefixes ST, C and N, comments; the word OFF is
/// optional. One vertex and one face per line, with or without a colour behind it, or words that
/// come out exactly (docs/conventions.md has the rule). Face colours are ignored. Refused: binary,
/// 4OFF, nOFF.
Mesh read_off(std::string_view text, const std::string& file, const ReadOptions& options,
              Warnings& warnings);

/// Reads a file of a format that holds one mesh: OBJ, PLY, STL or OFF.
Mesh read_mesh(FileFormat format, const files::InputFile& input, const std::string& file,
               const ReadOptions& options, Warnings& warnings);

/// The placed meshes of a glTF asset.
struct GltfAsset {
  std::vector<Mesh> meshes;
  /// Object::mesh counts from the first of `meshes`; Object::source is not set.
  std::vector<Object> objects;
  /// External buffers, in the order of loading; the asset's own file is left to the caller.
  std::vector<Source> buffers;
  /// The third-party libraries that have decoded parts of it: "Draco 1.5.5"; mostly empty.
  std::string reader;
};

/// Reads a glTF 2.0 asset (.gltf or .glb): one object per node with a mesh, depth first, of the
/// default scene, or of the first scene if there is no default; all nodes of an asset without
/// scenes, with a warning. Nodes that show the same glTF mesh share a Mesh. Faces are numbered over
/// all objects of the asset. No image is opened. If requested, triangles have material, group and
/// part: the names of the glTF material, mesh and node. Without a name these are called "material
/// 3", "mesh 3", "node 3" by their number in the file. A node with EXT_mesh_gpu_instancing gives an
/// object for each instance, with the node's name and its number: "tree[7]".
///
/// `path` names the file in messages; buffers in other files are looked for from its folder.
/// Exact    positions are binary32, widened, or integers (KHR_mesh_quantization), which are
///          rounded once where they are normalized; transforms of nodes and instances are composed
///          exactly, and a quaternion means the polynomial matrix of the glTF specification.
/// Fails    InputError: one line that names the file and the key or byte; also where buffers lie
///          outside the asset's folder, or reading would take more memory than the budget: see
///          ReadOptions::outside_files and max_expansion.
/// Ignored  with a warning: points, lines, skins, morph targets; silently: animations and cameras.
/// Source   [GLTF20]
GltfAsset read_gltf(std::span<const std::byte> bytes, const std::filesystem::path& path,
                    const ReadOptions& options, Warnings& warnings);

/// Removes normals and texture coordinates that are not finite, which programs write for triangles
/// without area: corners that name them lose them. Colours that are not finite become white, like
/// missing colours. A warning reports their number. Normals 0, 0, 0 are removed without a warning:
/// in STL files they mean the normal of the triangle.
void leave_out_odd_attributes(Mesh& mesh, const std::string& file, Warnings& warnings);

/// The format of a file: by its content or, if the content does not decide (an OBJ or OFF without a
/// typical word, an STL with an arbitrary header), by the suffix of its path, in upper or lower
/// case. Foreign formats (foreign_formats.h) are recognised only by their suffix. nullopt if
/// neither decides. `bytes` is the whole file of `size` bytes, or its beginning if only binary
/// formats matter.
std::optional<FileFormat> recognise_format(std::span<const std::byte> bytes, std::uint64_t size,
                                           const std::filesystem::path& path);
inline std::optional<FileFormat> recognise_format(std::span<const std::byte> bytes,
                                                  const std::filesystem::path& path) {
  return recognise_format(bytes, bytes.size(), path);
}

/// How files are read.
inline files::InputFile::Reading reading_of(const ReadOptions& options) {
  using Reading = files::InputFile::Reading;
  return options.map_large_files ? Reading::mapped_where_large : Reading::copied;
}

}  // namespace fathom::mesh_files
