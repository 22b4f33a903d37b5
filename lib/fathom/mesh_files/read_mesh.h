#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "fathom/mesh/mesh.h"
#include "fathom/mesh_files/read_options.h"

/// The readers of mesh files, one a format. Each takes the whole file, checks everything that Mesh
/// promises, and allocates no more than the bytes that are there can fill. `file` is the name in
/// messages. All fail with InputError: "FILE: line N: …" (text) or "FILE: byte N: …" (binary).
namespace fathom::mesh_files {

/// Wavefront OBJ: v, vt, vn and f lines; o, g, s, usemtl, mtllib and the like are ignored, other
/// keywords are ignored with a warning. Indices count from 1, negative ones backwards from the last
/// one read; positive ones may point forward. `v x y z w` is taken where w is 1; another w, which
/// belongs to rational curves, is refused, for programs differ in what they make of it. `v x y z r
/// g b [a]` has a colour; vertices without one are white. Parallel; the result does not depend on
/// it.
Mesh read_obj(std::string_view text, const std::string& file, const ReadOptions& options,
              Warnings& warnings);

/// PLY 1.0: ascii, binary little and big endian. Elements `vertex` (x, y, z and, if asked for,
/// nx ny nz, s t / u v / texture_u texture_v, red green blue alpha of any type) and `face`
/// (vertex_indices or vertex_index); other elements and properties are skipped. In ascii each
/// element stands on a line of its own. Refused: tristrips.
Mesh read_ply(std::span<const std::byte> bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings);

/// STL, ascii (several solids, any case) and binary, told apart by content. Each triangle has three
/// vertices of its own: STL does not say which are shared.
Mesh read_stl(std::span<const std::byte> bytes, const std::string& file, const ReadOptions& options,
              Warnings& warnings);

/// Object File Format, ascii: OFF with the prefixes ST, C and N, one vertex and one face a line,
/// comments; the word OFF is optional. Face colours are ignored. Refused: binary, 4OFF, nOFF.
Mesh read_off(std::string_view text, const std::string& file, const ReadOptions& options,
              Warnings& warnings);

}  // namespace fathom::mesh_files
