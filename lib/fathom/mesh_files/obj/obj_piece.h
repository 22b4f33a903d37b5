#pragma once

#include <string>
#include <string_view>

#include "fathom/mesh/mesh.h"
#include "fathom/mesh_files/obj/obj_counts.h"
#include "fathom/mesh_files/occurrences.h"

/// A piece of an OBJ. For this room's .cpp files only.
namespace fathom::mesh_files {

/// What a piece of the file has that cannot be used or is not usual, though its geometry is clear.
struct ObjOddities {
  Occurrences textures, normals, colours, weights;

  void add(const ObjOddities& later) {
    textures.add(later.textures);
    normals.add(later.normals);
    colours.add(later.colours);
    weights.add(later.weights);
  }
};

/// Reads one piece of the file into its place in the mesh, which has room for all of them. `before`
/// counts what comes before the piece, `total` what the file has.
/// Fails    InputError, naming file and line.
ObjOddities read_obj_piece(std::string_view text, const std::string& file, char line_end,
                           const ObjCounts& before, const ObjCounts& total, Mesh& mesh);

}  // namespace fathom::mesh_files
