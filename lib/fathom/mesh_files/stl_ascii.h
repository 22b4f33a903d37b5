#pragma once

#include <string>
#include <string_view>

#include "fathom/mesh/mesh.h"
#include "fathom/mesh_files/read_options.h"

namespace fathom::mesh_files {

/// STL that is text; see read_stl().
Mesh read_ascii_stl(std::string_view text, const std::string& file, const ReadOptions& options,
                    Warnings& warnings);

}  // namespace fathom::mesh_files
