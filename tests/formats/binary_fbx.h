#pragma once

#include <string>

#include "assimp_files.h"

namespace fathom::test {

/// A binary FBX file, of version 7.4, with one mesh. assimp 5.2 has an exporter "fbx", but leaves
/// out the end of a list of nodes, so that it cannot read what it wrote.
std::string binary_fbx(const Polygons& polygons);

}  // namespace fathom::test
