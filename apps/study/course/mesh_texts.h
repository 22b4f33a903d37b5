#pragma once

#include <string_view>

/// Files of data/meshes, so that the page's pictures need no folder of data (CMakeLists.txt).
namespace fathom::studies::mesh_texts {

extern const std::string_view cube, house, spot, teapot;

}  // namespace fathom::studies::mesh_texts
