#pragma once

#include <string>
#include <vector>

#include "fathom/mesh/mesh.h"

namespace fathom::test {

/// The faces of an OBJ file, with coordinates that are rounded to binary32.
struct Polygons {
  std::vector<MeshPoint> vertices;
  std::vector<std::vector<std::uint32_t>> faces;
};

/// `v` and `f` lines with one number per corner.
Polygons read_polygons(const std::string& obj_file);

/// The bytes of a file in one of assimp's formats: "collada", "3ds", "fbxa" (text), "3mf", "x",
/// "x3d"; or in "fbx" (binary), which it does not write.
std::string exported(const Polygons& polygons, const std::string& format);

}  // namespace fathom::test
