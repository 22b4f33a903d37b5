#pragma once

#include <array>
#include <string>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/mesh/mesh.h"

namespace fathom::test {

/// A mesh file in memory.
struct MeshFile {
  /// What is special about it; ends with the suffix of its format.
  std::string name;
  std::string bytes;
};

/// A small mesh of triangles whose coordinates every format can hold (binary32).
Mesh sample_mesh();

/// The mesh in every format and variant that the readers take.
std::vector<MeshFile> variants_of(const Mesh& mesh);

/// The corners of all triangles, which is what formats have in common.
using Soup = std::vector<std::array<MeshPoint, 3>>;
Soup soup_of(const Mesh& mesh);

/// Reads a file as read_scene() would, by its content and the suffix of its name.
Mesh read_variant(const MeshFile& file, Warnings& warnings, bool attributes = false);

}  // namespace fathom::test
