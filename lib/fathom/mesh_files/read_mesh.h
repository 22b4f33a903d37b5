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

/// The readers of mesh files, one per format. Each takes the whole file, checks everything that
/// Mesh promises, and allocates no more than the bytes that are there can fill. `file` is the name
/// for messages. All fail with InputError: "FILE: line N: …" (text) or "FILE: byte N: …" (binary).
namespace fathom::mesh_files {

/// Wavefront OBJ: v, vt, vn and f lines, and, if asked for, o, g and usemtl (obj_counts.h has how
/// names are read); s, mtllib and the like are ignored, other keywords are ignored with a warning.
/// Indices count from 1, negative ones backwards from the last one read; positive ones may point
/// forward. `v x y z w` is the point (x/w, y/w, z/w), with a warning unless w is 1. `v x y z r g b
/// [a]` has a colour; vertices without a colour are white. If no vertex has a z, every z is 0, with
/// a warning. A corner whose texture coordinate or normal is not in the file has none, with a
/// warning. Read in parallel, with a result that does not depend on it.
Mesh read_obj(std::string_view text, const std::string& file, const ReadOptions& options,
              Warnings& warnings);

/// PLY 1.0: ascii, binary little and big endian. Elements `vertex` (x, y, z and, if asked for,
/// nx ny nz, s t / u v / texture_u texture_v, red green blue alpha of any type), `face` and
/// `tristrips` (vertex_indices or vertex_index); other elements and properties are skipped. In
/// ascii rows are lines or, if exactly as many words are there, a stream of words (ply_text.h).
Mesh read_ply(std::span<const std::byte> bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings);

/// STL, ascii (several solids, any case, comments) and binary, distinguished by content. Each
/// triangle has three vertices of its own: STL does not say which are shared. With a warning:
/// facets without a normal, no endsolid, bytes after the last triangle.
Mesh read_stl(std::span<const std::byte> bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings);

/// Object File Format, ascii: OFF with the prefixes ST, C and N, comments; the word OFF is
/// optional. One vertex and one face per line, with or without a colour behind it, or words that
/// come out exactly (docs/conventions.md has the rule). Face colours are ignored. Refused: binary,
/// 4OFF, nOFF.
Mesh read_off(std::string_view text, const std::string& file, const ReadOptions& options,
              Warnings& warnings);

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

/// Leaves out normals and texture coordinates that are not finite, as programs write them for
/// triangles without area: the corners that name them have none. Colours that are not finite are
/// white, as where there is none. With a warning that says how many. Normals 0, 0, 0 are left out
/// too, without one: in STL files they say that the normal is that of the triangle.
void leave_out_odd_attributes(Mesh& mesh, const std::string& file, Warnings& warnings);

/// What a file is: by its content or, if that does not tell (an OBJ or OFF without a word that
/// gives it away, an STL whose header is arbitrary), by the suffix of its path, in any case.
/// Foreign formats (foreign_formats.h) are recognised by their suffix alone.
/// nullopt if neither tells. `bytes` is the whole file of `size` bytes, or its beginning if only
/// binary formats matter.
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
