#pragma once

#include <string>

#include "fathom/failures/warnings.h"
#include "fathom/mesh/mesh.h"

namespace fathom::mesh_files {

/// Leaves out normals and texture coordinates that are not finite, as programs write them for
/// triangles without area: the corners that name them have none. Colours that are not finite are
/// white, as where there is none. With a warning that says how many. Normals 0, 0, 0 are left out
/// too, without one: in STL files they say that the normal is that of the triangle.
void leave_out_odd_attributes(Mesh& mesh, const std::string& file, Warnings& warnings);

}  // namespace fathom::mesh_files
