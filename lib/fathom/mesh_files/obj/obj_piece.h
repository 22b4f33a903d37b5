#pragma once

#include <string>
#include <string_view>

#include "fathom/mesh/mesh.h"
#include "fathom/mesh_files/obj/obj_counts.h"
#include "fathom/mesh_files/occurrences.h"

/// A piece of an OBJ. Only for .cpp files of this module.
namespace fathom::mesh_files {

/// Unusable or unusual parts of a piece of the file that do not affect its geometry.
struct ObjOddities {
  Occurrences textures, normals, colours, weights;

  void add(const ObjOddities& later) {
    textures.add(later.textures);
    normals.add(later.normals);
    colours.add(later.colours);
    weights.add(later.weights);
  }
};

/// Reads one piece of the file into its place in the mesh, which has room for all pieces. `before`
/// counts the statements before the piece, `total` all statements of the file.
/// Fails    InputError, naming file and line.
ObjOddities read_obj_piece(std::string_view text, const std::string& file, char line_end,
                           const ObjCounts& before, const ObjCounts& total, Mesh& mesh);

}  // namespace fathom::mesh_files
