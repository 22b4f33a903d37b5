#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "fathom/mesh/mesh.h"
#include "fathom/mesh_files/read_options.h"

/// The readers of mesh files, one per format. Each takes the whole file, checks everything that
/// Mesh promises, and allocates no more than the bytes that are there can fill. `file` is the name
/// for messages. All fail with InputError: "FILE: line N: …" (text) or "FILE: byte N: …" (binary).
namespace fathom::mesh_files {

/// Wavefront OBJ: v, vt, vn and f lines, and, if asked for, o, g and usemtl (obj_segments.h has how
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

}  // namespace fathom::mesh_files
